// A guardian's life in this process, with clocks and a USB wire that are made up.

#include "haptics/devices/guard/watch.h"

#include "haptics/devices/falcon/falcon.h"
#include "haptics/devices/file_transport.h"
#include "haptics/devices/guard/guarded_driver.h"
#include "haptics/devices/hid/hid_drivers.h"
#include "tests/haptics/devices/guarded_phd1.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdarg>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <linux/usbdevice_fs.h>
#include <memory>
#include <string>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

namespace
{

std::atomic<std::int64_t> gSuspended = 0; // [ns]
std::atomic<int> gUsb = -1;               // a descriptor of usbfs
std::atomic<int> gTransfers = 0;
std::string gTransfer; // the last, and to which endpoint

} // namespace

// the clock that goes on while the machine is suspended goes ahead by so much
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept
{
  const auto result = static_cast<int>(syscall(SYS_clock_gettime, clock, time));
  if (clock == CLOCK_BOOTTIME)
  {
    time->tv_sec += gSuspended / 1'000'000'000;
  }
  return result;
}

extern "C" int ioctl(int file, unsigned long request, ...) noexcept
{
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (file != gUsb || request != USBDEVFS_BULK)
  {
    return static_cast<int>(syscall(SYS_ioctl, file, request, argument));
  }
  const auto* bulk = static_cast<usbdevfs_bulktransfer*>(argument);
  gTransfer = std::to_string(bulk->ep) + std::string(static_cast<char*>(bulk->data), bulk->len);
  ++gTransfers;
  return static_cast<int>(bulk->len);
}

namespace palp
{
namespace
{

using namespace std::chrono_literals;

// with a program that is this one, and a board that keeps what comes
class WatchedProgram : public ::testing::Test
{
protected:
  void begin(GuardWire wire, const ZeroPacket& zero)
  {
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, wire_.data()), 0);
    ASSERT_EQ(pipe(link_.data()), 0);
    alive_ = eventfd(0, 0);
    gUsb = wire_[0];
    gSuspended = 0;
    gTransfers = 0;
    block_.limit = std::chrono::nanoseconds(3500us).count();
    block_.wire = wire;
    block_.zero = zero;
    block_.beat = nanoseconds(CLOCK_MONOTONIC);
    guard_ = std::thread([this] { watch(block_, wire_[0], alive_, link_[0]); });
  }

  void TearDown() override
  {
    block_.closed = 1;
    close(link_[1]);
    guard_.join();
    close(link_[0]);
    close(alive_);
    close(wire_[0]);
    close(wire_[1]);
  }

  // of zeros that the board has got
  [[nodiscard]] int heard() const
  {
    std::array<std::byte, 128> in{};
    int count = 0;
    while (recv(wire_[1], in.data(), in.size(), 0) > 0)
    {
      ++count;
    }
    return count;
  }

  void beatFor(std::chrono::milliseconds time)
  {
    for (const auto end = std::chrono::steady_clock::now() + time;
         std::chrono::steady_clock::now() < end;)
    {
      block_.beat = nanoseconds(CLOCK_MONOTONIC) + 1'000'000'000; // never late on a loaded machine
      std::this_thread::sleep_for(1ms);
    }
  }

  GuardBlock block_;
  std::array<int, 2> wire_{};
  std::array<int, 2> link_{};
  int alive_ = -1;
  std::thread guard_;
};

TEST_F(WatchedProgram, IsLeftAloneWhileItBeatsOrHoldsNoForce)
{
  begin(GuardWire::File, woodenZero(14));
  block_.forced = 1;
  beatFor(30ms);
  EXPECT_EQ(block_.fired, 0U);
  block_.forced = 0;
  block_.beat = 0;
  std::this_thread::sleep_for(30ms);
  EXPECT_EQ(block_.fired, 0U);
  EXPECT_EQ(heard(), 0);
}

TEST_F(WatchedProgram, SilenceEndsItsForceOnceUntilItBeatsAgain)
{
  begin(GuardWire::File, woodenZero(14));
  block_.forced = 1;
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(block_.fired, 1U);
  EXPECT_EQ(heard(), 10);
  beatFor(10ms);
  block_.beat = nanoseconds(CLOCK_MONOTONIC);
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(block_.fired, 2U);
}

TEST_F(WatchedProgram, ASuspendEndsItsForceThoughNoBeatWasMissed)
{
  begin(GuardWire::File, woodenZero(14));
  block_.forced = 1;
  beatFor(10ms);
  gSuspended = 3'600'000'000'000;
  beatFor(50ms);
  EXPECT_EQ(block_.fired, 1U);
  EXPECT_GE(heard(), 1);
}

// the chip of a Falcon takes bytes at endpoint 2; letters as published: A is 0, B asks for homing
TEST_F(WatchedProgram, ZeroOfAFalconGoesOutThroughUsb)
{
  begin(GuardWire::Usb, falconZero());
  block_.forced = 1;
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(gTransfers, 10);
  EXPECT_EQ(gTransfer, "2<AAAAAAAAAAAABA>");
}

TEST(GuardedDriver, TellsAStopAfterASuspendAndSendsZero)
{
  gSuspended = 0;
  test::GuardedPhd1 arm;
  for (int i = 0; i < 20'000 && arm.force < 1.0; ++i) // a loaded machine may take it on the way
  {
    (void)arm.tick();
  }
  EXPECT_EQ(arm.force, 1.0);
  gSuspended = 60'000'000'000;
  EXPECT_TRUE(arm.tick().stopped);
  EXPECT_EQ(arm.force, 0.0);
}

TEST(GuardedDriver, WaitsForNoGuardianThatIsStopped)
{
  pid_t guardian = 0;
  {
    const test::GuardedPhd1 arm;
    std::ifstream("/proc/self/task/" + std::to_string(gettid()) + "/children") >> guardian;
    ASSERT_GT(guardian, 0);
    kill(guardian, SIGSTOP);
  }
  EXPECT_NE(kill(guardian, 0), 0) << "it is still there";
}

TEST(TwoPrograms, NeverDriveOneArm)
{
  const std::string node = testing::TempDir() + "palp_node";
  const int first = open(node.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  const int second = open(node.c_str(), O_RDWR | O_CLOEXEC);
  const int shared = dup(first); // as a guardian has it
  EXPECT_TRUE(takeForOneself(first));
  EXPECT_FALSE(takeForOneself(second));
  close(first);
  EXPECT_FALSE(takeForOneself(second));
  close(shared);
  EXPECT_TRUE(takeForOneself(second));
  close(second);
  unlink(node.c_str());
}

} // namespace
} // namespace palp
