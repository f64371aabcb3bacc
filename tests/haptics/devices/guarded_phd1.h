#pragma once

#include "haptics/devices/file_transport.h"
#include "haptics/devices/guard/guarded_driver.h"
#include "haptics/devices/hid/hid_drivers.h"

#include <array>
#include <gtest/gtest.h>
#include <memory>
#include <sys/socket.h>
#include <unistd.h>

namespace palp::test
{

/// A guarded driver that asks for 1 N, and the board at the other end of its wire.
class GuardedPhd1
{
public:
  GuardedPhd1()
  {
    std::array<int, 2> wire{};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, wire.data()), 0);
    board_ = wire[1];
    driver_ = guarded(std::make_unique<FileTransport>(wire[0]), phd1Zero(),
      [](std::unique_ptr<Transport> one) { return std::make_unique<Phd1Driver>(std::move(one)); });
  }
  ~GuardedPhd1()
  {
    close(board_);
  }
  GuardedPhd1(const GuardedPhd1&) = delete;
  GuardedPhd1& operator=(const GuardedPhd1&) = delete;

  DriverSample tick()
  {
    const auto state = encode(
      Phd1State{ .homed = true, .sequence = ++sequence_, .microseconds = 1000U * sequence_ });
    EXPECT_EQ(write(board_, state.data(), state.size()), static_cast<ssize_t>(state.size()));
    DriverSample sample;
    EXPECT_EQ(driver_->tick(Eigen::Vector3d(0, 0, 1), 0.001, sample), IoCode::Ok);
    std::array<std::byte, 128> in{};
    for (ssize_t size = 0; (size = recv(board_, in.data(), in.size(), 0)) > 0;)
    {
      const auto command =
        decodePhd1Command(Bytes(in).subspan(1, static_cast<std::size_t>(size) - 1));
      force = command ? command->force.z() : force;
    }
    return sample;
  }

  double force = -1.0; ///< that the board was told last [N]

private:
  int board_ = -1;
  std::uint16_t sequence_ = 0;
  std::unique_ptr<Driver> driver_;
};

} // namespace palp::test
