#include "app/program/interrupt.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

namespace palp
{
namespace
{

// as a factorization that nothing stops
[[noreturn]] void workOn()
{
  kill(getpid(), SIGTERM);
  std::this_thread::sleep_for(std::chrono::seconds(10));
  std::_Exit(0);
}

TEST(InterruptDeathTest, WorkThatDoesNotStopEndsOnceItsFilesAreInOrder)
{
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EXIT(
    {
      Interrupt interrupt;
      interrupt.endBy([] { return std::string("put in order"); });
      workOn();
    },
    testing::ExitedWithCode(5), "put in order");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
}

TEST(InterruptDeathTest, WorkThatStopsByItselfGoesOnToItsEnd)
{
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
    {
      Interrupt interrupt;
      interrupt.endBy([] { return std::string("put in order"); });
      interrupt.endBy({});
      kill(getpid(), SIGTERM);
      std::this_thread::sleep_for(std::chrono::seconds(3));
      std::_Exit(interrupt.token().stop_requested() ? 7 : 0);
    },
    testing::ExitedWithCode(7), "");
}

} // namespace
} // namespace palp
