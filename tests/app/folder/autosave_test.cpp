#include "app/folder/autosave.h"

#include "app/folder/export_folder.h"
#include "app/press/recorded_rows.h"
#include "haptics/error.h"
#include "haptics/servo/servo_step.h"
#include "tests/support/process.h"
#include "tests/support/surfaces.h"

#include <chrono>
#include <cmath>
#include <csignal>
#include <gtest/gtest.h>
#include <iterator>
#include <memory>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

// a press of so many milliseconds into a block
Recording pressOf(int milliseconds)
{
  static const auto block =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.2, 0.2, 0.1 }, 8)));
  Recording press;
  press.device = "mouse";
  press.scene.surface = block;
  for (int i = 0; i < milliseconds; ++i)
  {
    Sample sample = step(press.scene, { .apex = { 0.0, 0.0, -1e-6 * (i + 1) } });
    sample.time = 1e-3 * i;
    press.samples.push_back(sample);
  }
  return press;
}

ScenePlan plan()
{
  ScenePlan made;
  made.recording = RecordedPress{ .device = "mouse" };
  return made;
}

std::size_t rowsIn(const fs::path& folder)
{
  Recording again = pressOf(0);
  readRows(again, readExport(folder).plan.recording->file);
  return again.samples.size();
}

class AutosaveTest : public testing::Test
{
protected:
  [[nodiscard]] static std::vector<int> adoptAll(Autosave& autosave)
  {
    std::vector<int> numbers;
    for (const fs::path& press : autosave.left())
    {
      numbers.push_back(autosave.adopt(press));
    }
    return numbers;
  }

  test::TemporaryFolder folder_;
  fs::path root_ = folder_.path() / "state" / "presses";
};

TEST_F(AutosaveTest, LeavesWhatWasNotExportedToTheNextProgram)
{
  {
    Autosave first(root_);
    first.save(plan(), pressOf(20));
    first.save(plan(), pressOf(30));
    const Autosave other(root_);
    EXPECT_TRUE(other.left().empty()) << "the first goes on";
  }
  Autosave second(root_);
  ASSERT_EQ(second.left().size(), 2U);
  const auto adopted = adoptAll(second);
  ASSERT_EQ(adopted.size(), 2U);
  EXPECT_EQ(rowsIn(second.folderOf(adopted[0])), 20U);
  EXPECT_EQ(rowsIn(second.folderOf(adopted[1])), 30U);
  EXPECT_TRUE(second.left().empty());
  second.save(plan(), pressOf(5)); // takes no name of theirs
  const int exported = second.saved();
  second.save(plan(), pressOf(7)); // while the others are exported
  second.clear(exported);
  const fs::path own = second.folderOf(adopted[0]).parent_path();
  ASSERT_EQ(std::distance(fs::directory_iterator(own), {}), 1);
  EXPECT_EQ(rowsIn(fs::directory_iterator(own)->path()), 7U);
  second.clear();
  EXPECT_TRUE(Autosave(root_).left().empty());
}

TEST_F(AutosaveTest, KeepsNamesAndForgetsWhatWasDeleted)
{
  {
    Autosave first(root_);
    for (const int length : { 20, 30, 40 })
    {
      first.save(plan(), pressOf(length));
    }
    first.update(1, { "above the gallbladder" });
    first.update(2, {});
    first.update(3, {});
    first.update(3, { "brought back" });
  }
  Autosave second(root_);
  const auto adopted = adoptAll(second);
  ASSERT_EQ(adopted.size(), 2U);
  const ExportFolder named = readExport(second.folderOf(adopted[0]));
  EXPECT_EQ(named.plan.recording->names, std::vector<std::string>{ "above the gallbladder" });
  EXPECT_EQ(rowsIn(named.folder), 20U);
  EXPECT_EQ(rowsIn(second.folderOf(adopted[1])), 40U);
  second.update(adopted[0], {});
  second.clear();
  EXPECT_TRUE(Autosave(root_).left().empty());
}

TEST_F(AutosaveTest, LeavesNothingWhereNothingIsKept)
{
  Autosave(root_).clear();
  {
    Autosave discarding(root_);
    discarding.save(plan(), pressOf(20));
  }
  Autosave(root_).discard();
  EXPECT_TRUE(fs::is_empty(root_));
}

TEST_F(AutosaveTest, BringsBackWhatWasDiscardedUntilItEnds)
{
  for (const int length : { 20, 30 })
  {
    Autosave(root_).save(plan(), pressOf(length));
  }
  {
    Autosave next(root_);
    const std::vector<fs::path> before = next.left();
    ASSERT_EQ(before.size(), 2U);
    next.discard();
    EXPECT_TRUE(next.left().empty());
    next.clear(); // an export of presses since then
    next.undiscard();
    EXPECT_EQ(next.left(), before);
    EXPECT_EQ(rowsIn(before[1]), 30U);
    next.discard();
  }
  EXPECT_TRUE(Autosave(root_).left().empty());
  EXPECT_TRUE(fs::is_empty(root_));
}

TEST_F(AutosaveTest, KeepsNoMoreThanItsBound)
{
  {
    Autosave all(root_, 20);
    for (int i = 1; i <= 27; ++i)
    {
      all.save(plan(), pressOf(i));
    }
  }
  const auto left = Autosave(root_).left();
  ASSERT_EQ(left.size(), 20U);
  EXPECT_EQ(rowsIn(left.front()), 8U);
  EXPECT_EQ(rowsIn(left.back()), 27U);
}

// what is there is whole, and nothing before it is missing
TEST_F(AutosaveTest, AKillLosesThePressInProgressAtMost)
{
  std::mt19937 random(15);
  std::uniform_int_distribution<int> moment(0, 60);
  for (int trial = 0; trial < 30; ++trial)
  {
    const pid_t child = fork();
    if (child == 0)
    {
      Autosave mine(root_);
      for (int rows = 51;; ++rows)
      {
        mine.save(plan(), pressOf(rows));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(moment(random)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    Autosave next(root_);
    const auto left = next.left();
    for (std::size_t i = 0; i < left.size(); ++i)
    {
      EXPECT_EQ(rowsIn(left[i]), 51 + i);
    }
    next.discard();
  }
}

TEST_F(AutosaveTest, SaysOnceThatADiskIsFullAndGoesOn)
{
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{ .rlim_cur = 40'000, .rlim_max = before.rlim_max };
  Autosave mine(root_);
  setrlimit(RLIMIT_FSIZE, &small);
  mine.save(plan(), pressOf(2000));
  std::string said;
  for (int i = 0; i < 1000 && said.empty(); ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    try
    {
      mine.check();
    }
    catch (const Error& error)
    {
      said = error.what();
    }
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(said.find("File too large"), std::string::npos) << said;
  EXPECT_NO_THROW(mine.check());
  mine.update(1, { "renamed" });
  mine.save(plan(), pressOf(10)); // with room again
  ASSERT_TRUE(mine.has(1) && mine.has(2));
  EXPECT_EQ(rowsIn(mine.folderOf(1)), 2000U);
  EXPECT_EQ(
    readExport(mine.folderOf(1)).plan.recording->names, std::vector<std::string>{ "renamed" });
}

TEST_F(AutosaveTest, DoesNothingWhereItsFolderCannotBeMade)
{
  Autosave mine("/proc/none");
  EXPECT_TRUE(mine.folder().empty());
  mine.save(plan(), pressOf(10));
  EXPECT_NO_THROW(mine.check());
  EXPECT_TRUE(mine.left().empty());
  EXPECT_FALSE(mine.has(1));
}

} // namespace
} // namespace palp
