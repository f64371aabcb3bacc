#include "app/sweep/cases/claim.h"
#include "tests/support/process.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

class ClaimOfACase : public testing::Test
{
protected:
  /// A claim as another machine would have left it, that many seconds ago by the disk's clock
  void leaveFromElsewhere(int seconds) const
  {
    fs::create_directories(claims() / "case");
    const fs::path owner = claims() / "case" / "owner";
    std::ofstream(owner) << "another machine\n1\n1\n";
    fs::last_write_time(owner, fs::file_time_type::clock::now() - std::chrono::seconds(seconds));
  }
  [[nodiscard]] const fs::path& claims() const
  {
    return folder_.path();
  }

private:
  test::TemporaryFolder folder_;
};

TEST_F(ClaimOfACase, IsOfOneOfManyRunners)
{
  std::atomic<int> taken = 0;
  {
    std::vector<std::jthread> runners;
    for (int i = 0; i < 8; ++i)
    {
      runners.emplace_back([&] { taken += Claim::take(claims(), "case") ? 1 : 0; });
    }
  }
  EXPECT_EQ(taken, 1);
  EXPECT_TRUE(Claim::isHeld(claims(), "case"));
  EXPECT_EQ(std::distance(fs::directory_iterator(claims()), {}), 1); // nothing beside it
}

TEST_F(ClaimOfACase, IsGivenUpWithAllThatIsInIt)
{
  const auto claim = Claim::take(claims(), "case");
  ASSERT_TRUE(claim);
  std::ofstream(claim->folder() / "half a result") << "1";
  claim->release();
  EXPECT_TRUE(fs::is_empty(claims()));
  EXPECT_TRUE(Claim::take(claims(), "case"));
}

TEST_F(ClaimOfACase, OfAProcessThatWasKilledIsTakenOverAtOnce)
{
  const pid_t child = fork();
  if (child == 0)
  {
    const auto claim = Claim::take(claims(), "case");
    std::ofstream(claim->folder() / "half a result") << "1";
    _exit(claim ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  const auto claim = Claim::take(claims(), "case");
  ASSERT_TRUE(claim);
  EXPECT_FALSE(fs::exists(claim->folder() / "half a result"));
}

// asleep with its machine, or by Ctrl-Z: what it does when it goes on is its own
TEST_F(ClaimOfACase, OfAProcessThatWasStoppedIsTakenOverWhenItIsSilentForLong)
{
  std::array<int, 2> line{};
  ASSERT_EQ(pipe(line.data()), 0);
  const pid_t child = fork();
  if (child == 0)
  {
    const auto claim = Claim::take(claims(), "case");
    (void)!write(line[1], "x", 1);
    pause();
    _exit(claim ? 0 : 1);
  }
  char ready = 0;
  ASSERT_EQ(read(line[0], &ready, 1), 1);
  EXPECT_FALSE(Claim::take(claims(), "case"));
  fs::last_write_time(claims() / "case" / "owner",
    fs::file_time_type::clock::now() - std::chrono::seconds(kSilence + 60));
  EXPECT_TRUE(Claim::isHeld(claims(), "case")) << "it lives, whatever a clock says";
  EXPECT_FALSE(Claim::take(claims(), "case"));
  kill(child, SIGSTOP);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, WUNTRACED), child);
  ASSERT_TRUE(WIFSTOPPED(status));
  const fs::path its = std::find_if(fs::directory_iterator(claims() / "case"),
    fs::directory_iterator(),
    [](const auto& entry) {
      return entry.is_directory();
    })->path();
  EXPECT_FALSE(Claim::isHeld(claims(), "case"));
  const auto claim = Claim::take(claims(), "case");
  ASSERT_TRUE(claim);
  EXPECT_TRUE(fs::is_directory(claim->folder()));
  EXPECT_NE(claim->folder(), its);
  EXPECT_FALSE(fs::exists(its));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST_F(ClaimOfACase, FromElsewhereHoldsUntilItIsSilentForLong)
{
  leaveFromElsewhere(kSilence - 60);
  EXPECT_TRUE(Claim::isHeld(claims(), "case"));
  EXPECT_FALSE(Claim::take(claims(), "case"));
  leaveFromElsewhere(kSilence + 60);
  EXPECT_FALSE(Claim::isHeld(claims(), "case"));
  EXPECT_TRUE(Claim::take(claims(), "case"));
}

// a node whose clock is an hour ahead writes by the clock of the disk all the same
// one that lives beats again within seconds; of one that is gone nobody waits for an hour
TEST_F(ClaimOfACase, OfAClockThatWasSetBackIsHeldForTwoMinutesAtMost)
{
  leaveFromElsewhere(-60);
  EXPECT_TRUE(Claim::isHeld(claims(), "case"));
  leaveFromElsewhere(-3600);
  EXPECT_FALSE(Claim::isHeld(claims(), "case"));
}

TEST_F(ClaimOfACase, ThatAnotherTookOverIsNotGivenUpByTheFirst)
{
  const auto first = Claim::take(claims(), "case");
  leaveFromElsewhere(0); // as one would that took us for gone
  first->release();
  EXPECT_TRUE(Claim::isHeld(claims(), "case"));
}

} // namespace
} // namespace palp
