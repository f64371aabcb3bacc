#include "pipeline/child_process.h"

#include "haptics/error.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <stdexcept>
#include <unistd.h>
#include <vector>

namespace palp::test
{
namespace
{

constexpr ChildLimits kLimits{ .memory = 4ULL << 30, .time = 30 };

// what hangs on a lock takes no processor time, so a limit of that alone would wait for ever
TEST(ChildProcess, EndsWorkThatOnlyWaits)
{
  const auto wait = []() -> std::string
  {
    for (;;)
    {
      pause();
    }
  };
  EXPECT_FALSE(runInChild(wait, { .memory = kLimits.memory, .time = 1 }));
}

TEST(ChildProcess, CarriesOverWhatTheWorkReturns)
{
  // larger than any pipe, with every byte
  std::string bytes(3'000'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    bytes[i] = static_cast<char>(i * 7 + i / 251);
  }
  EXPECT_EQ(runInChild([&] { return bytes; }, kLimits), bytes);
  EXPECT_EQ(runInChild([] { return std::string(); }, kLimits), std::string());
}

TEST(ChildProcess, PassesAnErrorOn)
{
  try
  {
    (void)runInChild([]() -> std::string { throw Error(ErrorCode::BadMesh, "a: b; c"); }, kLimits);
    FAIL() << "no error came through";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadMesh);
    EXPECT_STREQ(error.what(), "a: b; c");
  }
}

TEST(ChildProcess, TurnsACrashIntoNothing)
{
  testing::internal::CaptureStderr();
  EXPECT_EQ(runInChild([]() -> std::string { std::abort(); }, kLimits), std::nullopt);
  EXPECT_EQ(runInChild(
              []
              {
                std::raise(SIGSEGV);
                return std::string();
              },
              kLimits),
    std::nullopt);
  EXPECT_EQ(runInChild([]() -> std::string { std::_Exit(3); }, kLimits), std::nullopt);
  EXPECT_EQ(runInChild([]() -> std::string { std::_Exit(0); }, kLimits), std::nullopt);
  EXPECT_EQ(runInChild([]() -> std::string { throw std::bad_alloc(); }, kLimits), std::nullopt);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ChildProcess, EndsWorkThatNeverEnds)
{
  const auto forever = []() -> std::string
  {
    for (std::atomic<int> i = 0;; ++i)
    {
    }
  };
  EXPECT_EQ(runInChild(forever, { .memory = 4ULL << 30, .time = 1 }), std::nullopt);
}

TEST(ChildProcess, PrintsNothing)
{
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_EQ(runInChild(
              []
              {
                std::cout << "out" << std::endl;
                std::cerr << "err" << std::endl;
                return std::string("done");
              },
              kLimits),
    "done");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// sanitizers reserve more address space than any limit
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(ChildProcess, EndsWorkThatWantsTooMuchMemory)
{
  const auto greedy = []
  {
    std::vector<std::string> hoard;
    for (int i = 0; i < 1000; ++i)
    {
      hoard.emplace_back(10'000'000, 'x');
    }
    return std::string("got ten gigabytes");
  };
  EXPECT_EQ(runInChild(greedy, { .memory = 200'000'000, .time = 30 }), std::nullopt);
}
#endif

} // namespace
} // namespace palp::test
