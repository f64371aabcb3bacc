#include "pipeline/process/child_process.h"

#include "haptics/error.h"
#include "haptics/threads/followed_work.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <memory>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace palp::test
{
namespace
{

std::optional<std::string> answering(const std::string& ending)
{
  return answerOf({ PALP_ANSWERING, ending });
}

TEST(ChildProcess, CarriesOverWhatTheWorkReturns)
{
  std::string bytes(3'000'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    bytes[i] = static_cast<char>(i * 7 + i / 251);
  }
  EXPECT_EQ(answering("bytes"), bytes);
  EXPECT_EQ(answering("nothing"), std::string());
}

TEST(ChildProcess, PassesAnErrorOn)
{
  try
  {
    (void)answering("error");
    FAIL() << "no error came through";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadMesh);
    EXPECT_STREQ(error.what(), "a: b; c");
  }
}

TEST(ChildProcess, NamesAProgramThatIsNotThere)
{
  try
  {
    (void)answerOf({ "/nowhere/reader" });
    FAIL() << "started from nowhere";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    EXPECT_TRUE(std::string(error.what()).starts_with("/nowhere/reader: cannot be started"));
  }
}

TEST(ChildProcess, TurnsACrashIntoNothing)
{
  testing::internal::CaptureStderr();
  for (const char* ending : { "abort", "segmentation", "exit 3", "exit 0", "no memory" })
  {
    EXPECT_EQ(answering(ending), std::nullopt) << ending;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// what hangs on a lock takes no processor time, so a limit of that alone would wait for ever
TEST(ChildProcess, EndsWhatOnlyWaits)
{
  EXPECT_EQ(answering("wait"), std::nullopt);
}

TEST(ChildProcess, EndsWhatNeverEnds)
{
  EXPECT_EQ(answering("work"), std::nullopt);
}

TEST(ChildProcess, TellsWhoFollowsHowFarItIs)
{
  FollowedWork work;
  const FollowedWork::OfThread followed(work);
  work.begin("reading");
  EXPECT_EQ(answering("half"), "done");
  EXPECT_EQ(work.step().what, "reading");
  EXPECT_EQ(work.step().done, 0.5);
}

// reaped before the caller hears of it: nothing reads on unseen
TEST(ChildProcess, EndsAtOnceWithWorkThatIsGivenUp)
{
  FollowedWork work;
  const auto begin = std::chrono::steady_clock::now();
  std::thread asks(
    [&work]
    {
      const FollowedWork::OfThread followed(work);
      EXPECT_THROW((void)answering("wait"), Error);
    });
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  work.giveUp();
  asks.join();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3)) << "6 s by itself";
}

// a copy of this process would now and then start with the allocator locked
TEST(ChildProcess, AnswersWhateverOtherThreadsDo)
{
  std::atomic<bool> done = false;
  const auto allocate = [&]
  {
    for (std::size_t size = 1; !done; size = size % 4096 + 1)
    {
      *std::make_unique<volatile char[]>(size).get() = 1;
    }
  };
  std::thread one(allocate);
  std::thread two(allocate);
  for (int i = 0; i < 20; ++i)
  {
    EXPECT_EQ(answering("nothing"), std::string());
  }
  done = true;
  one.join();
  two.join();
}

TEST(ChildProcess, PrintsNothing)
{
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_EQ(answering("print"), "done");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// sanitizers reserve more address space than any limit, and make calls of their own
#ifndef PALP_SANITIZED
TEST(ChildProcess, CanDoNothingButReadItsFile)
{
  const int inherited = open("/etc/passwd", O_RDONLY); // without O_CLOEXEC
  ASSERT_GE(dup2(inherited, 9), 0);
  std::string allowed;
  if (syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) < 1)
  {
    allowed = "read another file list a folder "; // an older kernel
  }
  EXPECT_EQ(answering("exploit"), allowed);
  EXPECT_EQ(answering("read"), "read");
  EXPECT_EQ(answering("privileges"), "NoNewPrivs:\t1");
  close(9);
  close(inherited);
}

// the reader of a program that is killed must not work on
TEST(ChildProcess, EndsWithTheProgramThatAsked)
{
  const pid_t parent = fork();
  if (parent == 0)
  {
    (void)answering("wait");
    _exit(0);
  }
  const std::string children =
    "/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children";
  std::string child;
  while (child.empty()) // until it was started
  {
    std::ifstream(children) >> child;
  }
  std::string name;
  while (name != "answering") // and runs
  {
    std::ifstream("/proc/" + child + "/comm") >> name;
    ASSERT_FALSE(name.empty());
  }
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  const auto alive = [&]
  {
    std::string line;
    std::ifstream in("/proc/" + child + "/stat");
    std::getline(in, line);
    return !line.empty() && line.find(") Z") == line.npos;
  };
  for (int i = 0; i < 200 && alive(); ++i) // its own limit comes after six seconds
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(alive());
}

TEST(ChildProcess, EndsWhatWantsTooMuchMemory)
{
  EXPECT_EQ(answering("greedy"), std::nullopt);
}
#endif

} // namespace
} // namespace palp::test
