#include "tests/rigs/made_up_falcon.h"

#include "haptics/devices/falcon/falcon.h"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <dlfcn.h>
#include <span>
#include <sys/ioctl.h>

namespace palp::test
{

namespace
{

int fail(int error)
{
  errno = error;
  return -1;
}

} // namespace

void MadeUpFalcon::hear(Bytes bytes)
{
  for (const std::byte byte : bytes)
  {
    if (loaded && divisor_ == 0x2)
    {
      run(byte);
    }
    else if (loading_ && divisor_ == 0x15)
    {
      firmware.push_back(byte);
      data_.push_back(byte);
    }
    else
    {
      heard_.push_back(byte);
      const std::string text(reinterpret_cast<const char*>(heard_.data()), heard_.size());
      if (divisor_ == 0x4138 && text.ends_with("\x0a\x43\x0d"))
      {
        push(std::as_bytes(std::span("\x0a\x44\x2c\x0d", 4)));
      }
      else if (divisor_ == 0x15 && byte == std::byte{ 0x41 })
      {
        data_.push_back(byte);
        loading_ = true;
      }
    }
  }
  serve();
}

void MadeUpFalcon::run(std::byte byte)
{
  if (byte == std::byte{ '<' })
  {
    heard_.clear();
  }
  heard_.push_back(byte);
  if (heard_.size() != kFalconPacket || byte != std::byte{ '>' })
  {
    return;
  }
  ++packets;
  int sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    unsigned word = 0;
    for (std::size_t nibble = 0; nibble < 4; ++nibble)
    {
      word |= ((std::to_integer<unsigned>(heard_[1 + 4 * i + nibble]) - 'A') & 0xFU)
        << (4 * nibble);
    }
    torques[i] = static_cast<std::int16_t>(word);
    sum += std::abs(torques[i]);
  }
  torque = sum;
  tooEarly += !homed && sum != 0 ? 1 : 0;
  if (mood == Mood::Garbage)
  {
    push(std::as_bytes(std::span("<AAxy>>z", 8)));
  }
  // letters of the published firmware, not of the driver: each nibble above A, the least first
  lights = std::to_integer<int>(heard_[13]) - 'A';
  std::string reply = "<";
  for (int leg = 0; leg < 3; ++leg)
  {
    for (int nibble = 0; nibble < 4; ++nibble)
    {
      reply += static_cast<char>('A' + ((counts >> (4 * nibble)) & 0xF));
    }
  }
  reply += static_cast<char>('A' + (homed ? 0x75 : 0x05));
  reply += "A>";
  push(std::as_bytes(std::span<const char>(reply)));
  heard_.clear();
}

void MadeUpFalcon::control(Bytes bytes)
{
  if (bytes[1] == std::byte{ 3 })
  {
    divisor_ = readInt<std::uint16_t>(bytes, 2);
    loaded = loaded || (divisor_ == 0x2 && !firmware.empty());
  }
  else if (bytes[1] == std::byte{ 6 }) // SIO_SET_EVENT_CHAR_REQUEST of libftdi: on in bit 8
  {
    const int value = readInt<std::uint16_t>(bytes, 2);
    eventCharacter_ = (value & 0x100) != 0 ? static_cast<std::byte>(value & 0xFF) : std::byte{ 0 };
  }
  else if (bytes[1] == std::byte{ 0 } && readInt<std::uint16_t>(bytes, 2) != 1)
  {
    data_.clear(); // 0 resets, 2 is SIO_TCIFLUSH of libftdi; 1 spares what waits for the host
  }
}

int MadeUpFalcon::submit(usbdevfs_urb& urb)
{
  if (gone_)
  {
    return fail(ENODEV);
  }
  const Bytes bytes(
    static_cast<const std::byte*>(urb.buffer), static_cast<std::size_t>(urb.buffer_length));
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL)
  {
    control(bytes);
    finish({ &urb, {} }, 0, 0);
  }
  else if (urb.endpoint == 0x02)
  {
    finish({ &urb, {} }, 0, urb.buffer_length);
    hear(bytes);
  }
  else if (halted_ || mood == Mood::Stalled)
  {
    halted_ = true; // until it is cleared, as a halted endpoint of USB 2.0, 9.4.5
    finish({ &urb, {} }, -EPIPE, 0);
  }
  else
  {
    waiting_.push_back({ &urb, Clock::now() + 1ms });
    serve();
  }
  return 0;
}

int MadeUpFalcon::reap(void** urb)
{
  if (done_.empty())
  {
    ring(false);
    return fail(gone_ ? ENODEV : EAGAIN);
  }
  *urb = done_.front();
  done_.pop_front();
  return 0;
}

int MadeUpFalcon::discard(const void* urb)
{
  const auto found = std::ranges::find(waiting_, urb, &Urb::urb);
  if (found == waiting_.end())
  {
    return fail(EINVAL);
  }
  const Urb discarded = *found;
  waiting_.erase(found);
  finish(discarded, -ENOENT, 0);
  return 0;
}

int MadeUpFalcon::answer(unsigned long request, void* argument)
{
  const std::lock_guard lock(mutex_);
  switch (request)
  {
    case USBDEVFS_GET_CAPABILITIES:
      *static_cast<std::uint32_t*>(argument) = USBDEVFS_CAP_BULK_CONTINUATION |
        USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      return 0;
    case USBDEVFS_GETDRIVER:
    case USBDEVFS_IOCTL: // no driver of the kernel's holds it
      return fail(ENODATA);
    case USBDEVFS_CLAIMINTERFACE:
    case USBDEVFS_RELEASEINTERFACE:
      claimed = request == USBDEVFS_CLAIMINTERFACE;
      return gone_ ? fail(ENODEV) : 0;
    case USBDEVFS_CLEAR_HALT:
      halted_ = halted_ && *static_cast<unsigned*>(argument) != 0x81;
      return 0;
    case USBDEVFS_SUBMITURB:
      return submit(*static_cast<usbdevfs_urb*>(argument));
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      return reap(static_cast<void**>(argument));
    case USBDEVFS_DISCARDURB:
      return discard(argument);
    default:
      return fail(ENOTTY);
  }
}

std::atomic<MadeUpFalcon*> gFalcon = nullptr;

} // namespace palp::test

// what libusb calls; everything that is not usbfs goes on to the C library
extern "C" int ioctl(int file, unsigned long request, ...) noexcept
{
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  palp::test::MadeUpFalcon* falcon = palp::test::gFalcon.load();
  if (falcon != nullptr && _IOC_TYPE(request) == 'U')
  {
    return falcon->answer(request, argument);
  }
  static const auto real =
    reinterpret_cast<int (*)(int, unsigned long, ...)>(dlsym(RTLD_NEXT, "ioctl"));
  return real(file, request, argument);
}
