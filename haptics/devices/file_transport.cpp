#include "haptics/devices/file_transport.h"

#include <cerrno>
#include <poll.h>
#include <sys/file.h>
#include <unistd.h>

namespace palp
{

FileTransport::~FileTransport()
{
  close(descriptor_);
}

IoResult FileTransport::read(MutableBytes into, std::chrono::microseconds timeout) noexcept
{
  pollfd one{ descriptor_, POLLIN, 0 };
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  const timespec wait{ seconds.count(),
    std::chrono::duration_cast<std::chrono::nanoseconds>(timeout - seconds).count() };
  const int ready = ppoll(&one, 1, &wait, nullptr);
  if (ready == 0 || (ready < 0 && errno == EINTR))
  {
    return { IoCode::Timeout, 0 };
  }
  if (ready < 0 || (one.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0)
  {
    return { IoCode::Gone, 0 };
  }
  const ssize_t size = ::read(descriptor_, into.data(), into.size());
  if (size > 0)
  {
    return { IoCode::Ok, static_cast<std::size_t>(size) };
  }
  const bool later = size < 0 && (errno == EAGAIN || errno == EINTR || errno == EINPROGRESS);
  return { later ? IoCode::Timeout : IoCode::Gone, 0 };
}

IoCode FileTransport::write(Bytes bytes) noexcept
{
  const ssize_t size = ::write(descriptor_, bytes.data(), bytes.size());
  return size == static_cast<ssize_t>(bytes.size()) ? IoCode::Ok : IoCode::Gone;
}

bool takeForOneself(int descriptor) noexcept
{
  return flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

} // namespace palp
