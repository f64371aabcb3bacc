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

// as libraries start them with a program, before its signals wait: they block none
void startThreads()
{
  for (int i = 0; i < 4; ++i)
  {
    std::thread([] { std::this_thread::sleep_for(std::chrono::minutes(1)); }).detach();
  }
}

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
      startThreads();
      Interrupt interrupt;
      interrupt.endBy([] { return std::string("put in order"); });
      workOn();
    },
    testing::ExitedWithCode(5), "put in order");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
}

TEST(InterruptDeathTest, WhatIsDoneLastIsDoneBeforeTheSignalEndsIt)
{
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
    {
      startThreads();
      Interrupt interrupt([] { (void)!write(STDERR_FILENO, "done last", 9); });
      workOn();
    },
    testing::KilledBySignal(SIGTERM), "done last");
}

TEST(InterruptDeathTest, WorkThatStopsByItselfGoesOnToItsEnd)
{
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
    {
      startThreads();
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
