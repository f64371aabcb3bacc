// Before a suspend: a double of logind, as its interface is published, on a bus of its own.

#include "haptics/devices/guard/sleep_notice.h"

#include "tests/haptics/devices/guarded_phd1.h"
#include "tests/support/private_bus.h"

#include <array>
#include <atomic>
#include <functional>
#include <gtest/gtest.h>
#include <poll.h>
#include <string_view>
#include <systemd/sd-bus.h>
#include <thread>

namespace palp
{
namespace
{

using namespace std::chrono_literals;

bool soon(const std::function<bool()>& isSo)
{
  for (int i = 0; i < 2000 && !isSo(); ++i)
  {
    std::this_thread::sleep_for(1ms);
  }
  return isSo();
}

class Logind
{
public:
  Logind()
    : thread_([this](const std::stop_token& stop) { run(stop); })
  {
    EXPECT_TRUE(soon([&] { return isThere_.load(); }));
  }

  /// Announces that the machine goes to sleep, or is back.
  void announce(bool leaves)
  {
    orders_ = leaves ? 1 : 2;
    EXPECT_TRUE(soon([&] { return orders_ == 0; }));
  }

  /// Whether somebody holds the sleep up; false: nobody, or no more.
  [[nodiscard]] bool isHeld() const
  {
    pollfd end{ pipe_, POLLIN, 0 };
    return end.fd >= 0 && poll(&end, 1, 0) == 0;
  }

  [[nodiscard]] int asked() const
  {
    return asked_;
  }

private:
  static int inhibit(sd_bus_message* call, void* at, sd_bus_error* error)
  {
    auto& self = *static_cast<Logind*>(at);
    std::array<const char*, 4> words{};
    if (sd_bus_message_read(call, "ssss", &words[0], &words[1], &words[2], &words[3]) < 0 ||
      std::string_view(words[0]) != "sleep" || std::string_view(words[3]) != "delay")
    {
      return sd_bus_error_set_const(error, SD_BUS_ERROR_INVALID_ARGS, "no delay of a sleep");
    }
    std::array<int, 2> ends{};
    EXPECT_EQ(pipe(ends.data()), 0);
    const int sent = sd_bus_reply_method_return(call, "h", ends[1]); // a copy
    close(ends[1]);
    self.pipe_ = ends[0];
    ++self.asked_;
    return sent;
  }

  void run(const std::stop_token& stop)
  {
    static const sd_bus_vtable table[] = { SD_BUS_VTABLE_START(0),
      SD_BUS_METHOD("Inhibit", "ssss", "h", inhibit, SD_BUS_VTABLE_UNPRIVILEGED),
      SD_BUS_SIGNAL("PrepareForSleep", "b", 0), SD_BUS_VTABLE_END };
    const char* path = "/org/freedesktop/login1";
    const char* name = "org.freedesktop.login1";
    sd_bus* bus = nullptr;
    EXPECT_GE(sd_bus_open_system(&bus), 0);
    EXPECT_GE(
      sd_bus_add_object_vtable(bus, nullptr, path, "org.freedesktop.login1.Manager", table, this),
      0);
    EXPECT_GE(sd_bus_request_name(bus, name, 0), 0);
    isThere_ = true;
    while (!stop.stop_requested() && sd_bus_process(bus, nullptr) >= 0)
    {
      if (const int order = orders_; order != 0)
      {
        sd_bus_emit_signal(
          bus, path, "org.freedesktop.login1.Manager", "PrepareForSleep", "b", order == 1 ? 1 : 0);
        orders_ = 0;
      }
      sd_bus_wait(bus, 1000);
    }
    sd_bus_flush_close_unref(bus);
  }

  std::atomic<bool> isThere_ = false;
  std::atomic<int> orders_ = 0;
  std::atomic<int> asked_ = 0;
  std::atomic<int> pipe_ = -1; // whose other end holds it up
  std::jthread thread_;
};

TEST(SleepNotice, HoldsASuspendUpUntilTheMotorsHaveZeroAndThenNoLonger)
{
  auto bus = std::make_unique<test::PrivateBus>();
  bus->startDaemon();
  Logind logind;
  GuardBlock block;
  std::jthread follower([&] { followSleep(block); });
  ASSERT_TRUE(soon([&] { return logind.isHeld(); }));
  for (const int night : { 1, 2 })
  {
    block.forced = 1;
    logind.announce(true);
    EXPECT_TRUE(soon([&] { return block.leaving == 1; })) << night;
    std::this_thread::sleep_for(50ms);
    EXPECT_TRUE(logind.isHeld()) << "while a force is held";
    block.forced = 0; // as a program does once its zero is out
    EXPECT_TRUE(soon([&] { return !logind.isHeld(); })) << night;
    logind.announce(false);
    EXPECT_TRUE(soon([&] { return block.leaving == 0 && logind.asked() == night + 1; }));
    EXPECT_TRUE(soon([&] { return logind.isHeld(); })) << "for the next";
  }
  block.forced = 1; // by a program that sends no zero any more
  logind.announce(true);
  EXPECT_TRUE(soon([&] { return !logind.isHeld(); })) << "no longer than 0.2 s";
  bus.reset(); // the bus goes away
  follower.join();
  EXPECT_EQ(block.leaving, 0U);
}

// the guardian hears of it, the program sends the zero
TEST(SleepNotice, ADriverSendsZeroAndTellsAStopBeforeTheMachineSleeps)
{
  test::PrivateBus bus;
  bus.startDaemon();
  Logind logind;
  test::GuardedPhd1 arm;
  ASSERT_TRUE(soon([&] { return logind.isHeld(); }));
  const auto isStopped = [&] { return arm.tick().stopped; };
  EXPECT_TRUE(soon([&] { return !isStopped() && arm.force == 1.0; }));
  logind.announce(true);
  EXPECT_TRUE(soon(isStopped));
  EXPECT_EQ(arm.force, 0.0);
  EXPECT_TRUE(soon([&] { return isStopped() && !logind.isHeld(); }));
}

TEST(SleepNotice, IsDoneWithoutWhereThereIsNoLogind)
{
  GuardBlock block;
  test::PrivateBus bus;
  followSleep(block);
  bus.startDaemon();
  followSleep(block); // a bus, and nobody of that name
  EXPECT_EQ(block.leaving, 0U);
}

} // namespace
} // namespace palp
