#include "haptics/devices/haply/haply_link.h"

#include "haptics/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <libwebsockets.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <utility>
#include <vector>

namespace palp
{

using namespace std::chrono_literals;

// what runs in the thread of the link
struct HaplyLink::Service
{
  static constexpr std::size_t kLargest = 65'536; // of a message: all devices of a desk are a tenth

  explicit Service(HaplyLink& link, std::uint16_t port);
  ~Service()
  {
    lws_context_destroy(context);
  }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  static int callback(
    lws* socket, lws_callback_reasons reason, void* unused, void* data, std::size_t size);
  bool receive(lws* socket, std::string_view part);
  bool send(lws* socket);
  void endForce();
  void run(const std::stop_token& stop);
  void end() noexcept
  {
    link.gone_ = true;
    ring();
  }
  void ring() const noexcept
  {
    (void)eventfd_write(link.replies_.get(), 1);
  }

  HaplyLink& link;
  HaplyState state;
  std::string message; // as far as it has come
  int answered = 0;    // commands that went out
  lws* connection = nullptr;
  lws_context* context = nullptr;
};

HaplyLink::Service::Service(HaplyLink& owner, std::uint16_t port)
  : link(owner)
{
  static const std::array protocols{ lws_protocols{ "haply", &callback, 0, 4096, 0, nullptr, 0 },
    lws_protocols{} };
  lws_set_log_level(0, nullptr);
  lws_context_creation_info information{};
  information.port = CONTEXT_PORT_NO_LISTEN;
  information.protocols = protocols.data();
  information.options = LWS_SERVER_OPTION_DISABLE_IPV6;
  information.user = this;
  context = lws_create_context(&information);
  lws_client_connect_info where{};
  where.context = context;
  where.address = "127.0.0.1";
  where.host = "localhost";
  where.origin = "localhost";
  where.path = "/";
  where.port = port;
  where.local_protocol_name = "haply";
  if (context == nullptr || lws_client_connect_via_info(&where) == nullptr)
  {
    link.gone_ = true;
  }
}

int HaplyLink::Service::callback(
  lws* socket, lws_callback_reasons reason, void*, void* data, std::size_t size)
{
  const auto self = [&]
  { return static_cast<Service*>(lws_context_user(lws_get_context(socket))); };
  switch (reason)
  {
    case LWS_CALLBACK_CLIENT_ESTABLISHED:
      self()->connection = socket;
      self()->link.socket_ = Descriptor(fcntl(lws_get_socket_fd(socket), F_DUPFD_CLOEXEC, 0));
      return 0;
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED: // a force waits
      if (self()->connection != nullptr)
      {
        lws_callback_on_writable(self()->connection);
      }
      return 0;
    case LWS_CALLBACK_CLIENT_RECEIVE:
      if (!self()->receive(socket, { static_cast<const char*>(data), size }))
      {
        self()->end(); // a socket that is hung up here could not be sent zero any more
      }
      return 0;
    case LWS_CALLBACK_CLIENT_WRITEABLE:
      if (!self()->send(socket))
      {
        self()->end();
      }
      return 0;
    case LWS_CALLBACK_WS_PEER_INITIATED_CLOSE: // what follows our own close is not read
      self()->endForce();
      return 0;
    case LWS_CALLBACK_CLIENT_CONNECTION_ERROR:
    case LWS_CALLBACK_CLIENT_CLOSED:
      self()->endForce();
      self()->connection = nullptr;
      self()->end();
      return 0;
    default:
      return 0;
  }
}

bool HaplyLink::Service::receive(lws* socket, std::string_view part)
{
  if (link.gone_ || message.size() + part.size() > kLargest)
  {
    return false;
  }
  message += part;
  if (lws_is_final_fragment(socket) == 0 || lws_remaining_packet_payload(socket) > 0)
  {
    return true;
  }
  const bool understood = takeHaplyMessage(message, state);
  message.clear();
  if (understood)
  {
    link.states_.publish(state);
    ring();
  }
  return understood;
}

bool HaplyLink::Service::send(lws* socket)
{
  const int asked = link.asked_;
  if (asked == answered || state.id.front() == 0)
  {
    return true;
  }
  const Eigen::Vector3d& force = link.forces_.read();
  const bool pushes = !force.isZero(0.0);
  link.pushes_ = link.pushes_ || pushes;
  const std::string text = haplyCommand(state, force, answered == 0);
  answered = asked;
  std::vector<unsigned char> buffer(LWS_PRE + text.size());
  std::memcpy(buffer.data() + LWS_PRE, text.data(), text.size());
  const bool isSent = lws_write(socket, buffer.data() + LWS_PRE, text.size(), LWS_WRITE_TEXT) >= 0;
  link.pushes_ = pushes || !isSent;
  return isSent;
}

// past the library, which takes nothing more for a connection that it gives up
void HaplyLink::Service::endForce()
{
  if (link.pushes_)
  {
    const ZeroPacket zero = haplyZero(state);
    (void)::send(link.socket_.get(), zero.bytes.data(), zero.size, MSG_DONTWAIT | MSG_NOSIGNAL);
  }
}

// however it ends, the last command is one of no force
void HaplyLink::Service::run(const std::stop_token& stop)
{
  while (!stop.stop_requested() && !link.gone_ && lws_service(context, 0) >= 0)
  {
  }
  endForce();
  end();
}

HaplyLink::HaplyLink(std::uint16_t port)
  : replies_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC))
  , service_(std::make_unique<Service>(*this, port))
  , thread_([this](const std::stop_token& stop) { service_->run(stop); })
{
  constexpr auto kPatience = 1s;
  (void)waitForReply(kPatience);
  if (states_.read().id.front() == 0)
  {
    stop();
    const std::string place = "localhost:" + std::to_string(port);
    throw Error(ErrorCode::NoDevice,
      "Haply Inverse3: no service at " + place +
        " that knows one; plug it in and start the Haply Inverse Service");
  }
}

HaplyLink::~HaplyLink()
{
  stop();
}

void HaplyLink::stop() noexcept
{
  thread_.request_stop();
  if (service_->context != nullptr)
  {
    lws_cancel_service(service_->context);
  }
  thread_.join();
}

bool HaplyLink::exchange(const Eigen::Vector3d& force, std::chrono::microseconds wait) noexcept
{
  eventfd_t late = 0;
  (void)eventfd_read(replies_.get(), &late);
  forces_.publish(force);
  ++asked_;
  lws_cancel_service(service_->context);
  return waitForReply(wait) && !gone_;
}

bool HaplyLink::waitForReply(std::chrono::microseconds wait) noexcept
{
  pollfd one{ replies_.get(), POLLIN, 0 };
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(wait);
  const timespec most{ whole.count(),
    std::chrono::duration_cast<std::chrono::nanoseconds>(wait - whole).count() };
  eventfd_t rung = 0;
  return ppoll(&one, 1, &most, nullptr) > 0 && eventfd_read(replies_.get(), &rung) == 0;
}

} // namespace palp
