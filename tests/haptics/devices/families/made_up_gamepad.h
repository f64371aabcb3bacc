#pragma once

// A game pad as the kernel's evdev shows one, by numbers of its own: Documentation/input and
// include/uapi/linux/input.h, input-event-codes.h of Linux 6.1, on a machine of 64 bits. What a
// program asks its node comes to ioctl(), which the test defines; events are bytes of a socket.

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace palp::test
{

class MadeUpGamepad
{
public:
  static constexpr std::size_t kEvent = 24;  // bytes: time 16, type 2, code 2, value 4
  static constexpr std::size_t kEffect = 48; // bytes: type, id, direction, trigger, replay; at 16 u

  explicit MadeUpGamepad(bool rumbles = true)
    : rumbles_(rumbles)
  {
    int ends[2];
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends), 0);
    node = ends[0];
    far_ = ends[1];
  }
  ~MadeUpGamepad()
  {
    unplug();
  }
  MadeUpGamepad(const MadeUpGamepad&) = delete;
  MadeUpGamepad& operator=(const MadeUpGamepad&) = delete;

  void unplug()
  {
    close(std::exchange(far_, -1));
  }

  int node; // for the program, which closes it

  void tell(std::uint16_t type, std::uint16_t code, std::int32_t value) const
  {
    std::array<unsigned char, kEvent> event{};
    std::memcpy(&event[16], &type, 2);
    std::memcpy(&event[18], &code, 2);
    std::memcpy(&event[20], &value, 4);
    EXPECT_EQ(send(far_, event.data(), event.size(), MSG_NOSIGNAL), 24);
  }

  struct Command
  {
    std::uint16_t type;
    std::uint16_t code;
    std::int32_t value;
  };

  // what the program has written since it was asked last
  [[nodiscard]] std::vector<Command> heard() const
  {
    std::vector<Command> commands;
    std::array<unsigned char, 256> bytes{};
    for (ssize_t size = 0; (size = recv(far_, bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0;)
    {
      EXPECT_EQ(size, 24);
      Command command{};
      std::memcpy(&command.type, &bytes[16], 2);
      std::memcpy(&command.code, &bytes[18], 2);
      std::memcpy(&command.value, &bytes[20], 4);
      commands.push_back(command);
    }
    return commands;
  }

  // an ioctl of its node: direction, size, letter and number as _IOC packs them
  int control(unsigned long request, unsigned char* data)
  {
    const unsigned long direction = request >> 30;
    const std::size_t size = request >> 16 & 0x3FFF;
    const unsigned long number = request & 0xFF;
    EXPECT_EQ(request >> 8 & 0xFF, 0x45U); // 'E'
    if (direction == 1 && number == 0x80)  // EVIOCSFF
    {
      return upload(size, data);
    }
    EXPECT_EQ(direction, 2U); // all others read
    std::memset(data, 0, size);
    const auto set = [&](unsigned bit)
    { data[bit / 8] |= static_cast<unsigned char>(1U << bit % 8); };
    if (number == 0x06) // EVIOCGNAME
    {
      std::strncpy(reinterpret_cast<char*>(data), "Made Up Pad", size);
    }
    else if (number == 0x18) // EVIOCGKEY: what is held
    {
      southIsHeld ? set(0x130) : void();
    }
    else if (number == 0x20 + 1) // EVIOCGBIT of EV_KEY
    {
      set(0x130);
      set(0x131);
    }
    else if (number == 0x20 + 3) // of EV_ABS
    {
      set(0);
    }
    else if (number == 0x20 + 0x15) // of EV_FF
    {
      rumbles_ ? set(0x50) : void();
    }
    else if (number >= 0x40 &&
      number < 0x80) // EVIOCGABS: value, minimum, maximum, fuzz, flat, resolution
    {
      EXPECT_EQ(size, 24U);
      const bool isHat = number >= 0x50;
      const std::array<std::int32_t, 6> stick{ number == 0x40 ? stickX : 0, -32768, 32767, 16, 128,
        0 };
      const std::array<std::int32_t, 6> hat{ 0, -1, 1, 0, 0, 0 };
      std::memcpy(data, isHat ? hat.data() : stick.data(), 24);
    }
    return 0;
  }

  std::atomic<bool> southIsHeld = false;
  std::int32_t stickX = 0;
  std::vector<int> strengths; // 0 to 65535, as they were uploaded
  int effects = 0;            // of which it has room for one

private:
  int upload(std::size_t size, unsigned char* data)
  {
    EXPECT_EQ(size, kEffect);
    const auto word = [&](std::size_t at)
    {
      std::uint16_t value = 0;
      std::memcpy(&value, data + at, 2);
      return value;
    };
    EXPECT_EQ(word(0), 0x50); // FF_RUMBLE
    EXPECT_EQ(word(10), 200); // it ends by itself [ms]
    EXPECT_EQ(word(12), 0);   // and begins at once
    if (word(2) == 0xFFFF)    // -1: a new one
    {
      ++effects;
      const std::uint16_t number = 3;
      std::memcpy(data + 2, &number, 2);
    }
    else
    {
      EXPECT_EQ(word(2), 3);
    }
    strengths.push_back(word(16));
    return 0;
  }

  bool rumbles_;
  int far_;
};

} // namespace palp::test
