#pragma once

// A daemon made up from spacenavd's proto_unix.c: events of eight integers through a local socket,
// a change of protocol first.

#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace palp::test
{

using Axes = std::array<int, 6>;

class SpacenavDaemon
{
public:
  explicit SpacenavDaemon(bool old = false)
    : path_(testing::TempDir() + "palp_spnav_" + std::to_string(getpid()))
    , listening_(socket(AF_UNIX, SOCK_STREAM, 0))
  {
    unlink(path_.c_str());
    sockaddr_un place{};
    place.sun_family = AF_UNIX;
    path_.copy(place.sun_path, sizeof(place.sun_path) - 1);
    EXPECT_EQ(bind(listening_, reinterpret_cast<const sockaddr*>(&place), sizeof(place)), 0);
    EXPECT_EQ(listen(listening_, 1), 0);
    setenv("SPNAV_SOCKET", path_.c_str(), 1);
    greeter_ = std::jthread(
      [this, old]
      {
        client_ = accept(listening_, nullptr, nullptr);
        unsigned asked = 0;
        EXPECT_EQ(read(client_, &asked, sizeof(asked)), 4);
        EXPECT_EQ(asked & 0xFFFFFF00U, 0x7FAA5500U);
        const unsigned agreed = 0x7FAA5501U;
        if (!old) // an old one takes it for a sensitivity that is no number
        {
          EXPECT_EQ(write(client_, &agreed, sizeof(agreed)), 4);
        }
      });
  }
  ~SpacenavDaemon()
  {
    stop();
    close(listening_);
    unlink(path_.c_str());
  }
  SpacenavDaemon(const SpacenavDaemon&) = delete;
  SpacenavDaemon& operator=(const SpacenavDaemon&) = delete;

  void stop()
  {
    if (greeter_.joinable())
    {
      greeter_.join();
    }
    close(std::exchange(client_, -1));
  }

  // of a mouse whose axes are x right, y to the user, z down, by the daemon's own defaults
  void move(const Axes& raw)
  {
    constexpr std::array<std::size_t, 6> kMap{ 0, 2, 1, 3, 5, 4 };
    constexpr Axes kInverted{ 0, 1, 1, 0, 1, 1 };
    std::array<int, 8> event{};
    for (std::size_t i = 0; i < 6; ++i)
    {
      event[1 + kMap[i]] = kInverted[i] != 0 ? -raw[i] : raw[i];
    }
    event[7] = 16;
    say(event);
  }

  void press(int button, bool down)
  {
    say({ down ? 1 : 2, button });
  }

private:
  void say(const std::array<int, 8>& event)
  {
    greeter_.joinable() ? greeter_.join() : void();
    EXPECT_EQ(write(client_, event.data(), sizeof(event)), 32);
  }

  std::string path_;
  int listening_;
  int client_ = -1;
  std::jthread greeter_;
};

} // namespace palp::test
