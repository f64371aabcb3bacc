#include "haptics/devices/openigtlink/openigtlink_driver.h"

#include "haptics/error.h"

#include <arpa/inet.h>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <sys/socket.h>
#include <utility>

namespace palp
{
namespace
{

constexpr double kPatience = 1.0; // with a silent peer, while another waits [s]
constexpr double kForceEvery =
  0.01;                    // [s]: as often as a picture may want it, not as a servo has it
constexpr int kReads = 16; // in a tick: a peer that floods must not hold it up

struct Name
{
  std::string address = "127.0.0.1"; // nobody outside this machine, unless the user says so
  std::uint16_t port = 18944;
  std::string tool;
};

Name parseName(const std::string& text)
{
  Name name;
  const std::size_t comma = text.find(',');
  name.tool = comma == text.npos ? "" : text.substr(comma + 1);
  const std::string place = text.substr(0, comma);
  const std::size_t colon = place.find(':');
  name.address = colon == 0 || place.empty() ? name.address : place.substr(0, colon);
  bool valid = true;
  if (colon != place.npos)
  {
    const char* end = place.data() + place.size();
    const auto read = std::from_chars(place.data() + colon + 1, end, name.port);
    valid = read.ec == std::errc{} && read.ptr == end && name.port > 0;
  }
  in_addr unused{};
  constexpr std::size_t kLongest = 20; // that the protocol has room for
  if (!valid || name.tool.size() > kLongest ||
    inet_pton(AF_INET, name.address.c_str(), &unused) != 1)
  {
    throw Error(ErrorCode::BadValue,
      "--device: openigtlink:" + text +
        ": not an address and port to listen at and a name of 20 letters; write as in "
        "openigtlink:127.0.0.1:18944,Probe");
  }
  return name;
}

Descriptor listenAt(const Name& name)
{
  Descriptor listening(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  (void)setsockopt(listening.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(name.port);
  (void)inet_pton(AF_INET, name.address.c_str(), &place.sin_addr);
  if (bind(listening.get(), reinterpret_cast<const sockaddr*>(&place), sizeof(place)) != 0 ||
    listen(listening.get(), 2) != 0)
  {
    throw Error(ErrorCode::NoDevice,
      "OpenIGTLink: cannot listen at " + name.address + ":" + std::to_string(name.port) +
        (errno == EADDRINUSE ? ", another program does; close it or give another port"
                             : "; give an address of this machine and a free port"));
  }
  return listening;
}

} // namespace

OpenIgtLinkDriver::OpenIgtLinkDriver(Descriptor listening, std::string tool)
  : listening_(std::move(listening))
  , reader_(std::move(tool))
{
}

DeviceLimits OpenIgtLinkDriver::limits() const
{
  return { .model = "OpenIGTLink tracker", .needsHoming = true };
}

IoCode OpenIgtLinkDriver::tick(const Wrench& wrench, double dt, DriverSample& sample) noexcept
{
  std::optional<TrackedPose> newest;
  accept(dt);
  if (peer_)
  {
    receive(newest);
    send(wrench.force, dt);
  }
  if (newest)
  {
    seen_ = true;
    sample = { .position = newest->position, .orientation = newest->orientation };
    return IoCode::Ok;
  }
  if (seen_)
  {
    return IoCode::Timeout;
  }
  sample.homed = false; // but it is there before any tracker is
  return IoCode::Ok;
}

void OpenIgtLinkDriver::accept(double dt) noexcept
{
  silent_ += dt;
  if (peer_ && silent_ < kPatience)
  {
    return;
  }
  Descriptor next(accept4(listening_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (next)
  {
    hangUp();
    peer_ = std::move(next);
    silent_ = 0.0;
  }
}

void OpenIgtLinkDriver::hangUp() noexcept
{
  peer_ = Descriptor();
  reader_.restart();
  sent_ = out_.size();
}

// a peer that reads nothing gets no more, and no half message is ever left without its other half
void OpenIgtLinkDriver::send(const Eigen::Vector3d& force, double dt) noexcept
{
  sinceOut_ += dt;
  if (sent_ == out_.size() && sinceOut_ >= kForceEvery)
  {
    out_ = encodeIgtlForce(force);
    sent_ = 0;
    sinceOut_ = 0.0;
  }
  if (peer_ && sent_ < out_.size())
  {
    const ssize_t size =
      ::send(peer_.get(), out_.data() + sent_, out_.size() - sent_, MSG_DONTWAIT | MSG_NOSIGNAL);
    sent_ += size > 0 ? static_cast<std::size_t>(size) : 0;
  }
}

void OpenIgtLinkDriver::receive(std::optional<TrackedPose>& newest) noexcept
{
  std::array<std::byte, 4096> bytes; // NOLINT(cppcoreguidelines-pro-type-member-init): read into
  for (int i = 0; i < kReads && peer_; ++i)
  {
    const ssize_t size = recv(peer_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (size < 0 && (errno == EAGAIN || errno == EINTR))
    {
      return;
    }
    silent_ = 0.0;
    if (size <= 0 || !reader_.take(Bytes(bytes).first(static_cast<std::size_t>(size)), newest))
    {
      hangUp();
    }
  }
}

std::unique_ptr<Driver> openOpenIgtLink(const std::string& name)
{
  const Name parsed = parseName(name);
  return std::make_unique<OpenIgtLinkDriver>(listenAt(parsed), parsed.tool);
}

} // namespace palp
