#include "tests/haptics/files/output_rig.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <thread>

namespace palp
{
namespace
{

class LeftBehind : public OutputRig
{
};

// somebody else may write into the folder, and name anything there
TEST_F(LeftBehind, EndsNoPublishingOutsideOfItsFolder)
{
  write("1");
  std::ofstream(folder_.path() / "mine.txt") << "mine";
  std::filesystem::create_directories(out_ / ".palp-abcdef");
  std::ofstream(out_ / ".palp-abcdef" / ".dropped")
    << "../../mine.txt\n"
    << (folder_.path() / "mine.txt").string() << '\n';
  write("2", Earlier::Replace);
  EXPECT_EQ(test::readAll(folder_.path() / "mine.txt"), "mine");
  expectBoth("2");
}

// a table that takes minutes is written beside what other runs leave
TEST_F(LeftBehind, LeavesWhatAnotherProcessIsWriting)
{
  write("1");
  const auto agesAgo = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
  replaceFile(out_ / "table.csv",
    [&](const std::filesystem::path& fresh)
    {
      std::ofstream(fresh) << "rows";
      std::filesystem::last_write_time(fresh.parent_path(), agesAgo);
      write("2", Earlier::Replace);
      EXPECT_EQ(test::readAll(fresh), "rows");
    });
  EXPECT_EQ(test::readAll(out_ / "table.csv"), "rows");
  std::filesystem::create_directories(out_ / ".palp-new-abcdef");
  std::filesystem::create_directories(out_ / ".palp-file-abcdef");
  clearStages(out_);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out_), {}), 3);
}

// one that is cleared between being made and being locked is made anew
TEST_F(LeftBehind, AnswersNoStageThatAnotherProcessClears)
{
  std::filesystem::create_directories(out_);
  std::atomic<bool> isDone{ false };
  std::thread other(
    [&]
    {
      while (!isDone)
      {
        clearStages(out_);
      }
    });
  for (int i = 0; i < 3000; ++i)
  {
    const Stage stage = makeStage(out_);
    std::this_thread::sleep_for(std::chrono::microseconds(i % 100));
    ASSERT_TRUE(std::filesystem::exists(stage.path)) << i;
    std::filesystem::remove_all(stage.path);
  }
  isDone = true;
  other.join();
}

// a killed run's folder beside a new one's is known by its lock, and finished where it was complete
TEST_F(LeftBehind, FinishesWhatWasCompleteBesideIt)
{
  write("1");
  const std::filesystem::path other = out_.parent_path() / "other";
  std::filesystem::create_directories(other);
  std::ofstream(other / "plot.png") << "old";
  const std::filesystem::path complete = out_.parent_path() / ".other.palp-abcdef";
  std::filesystem::create_directories(complete);
  std::ofstream(complete / "a.csv") << "new";
  std::ofstream(complete / ".dropped") << "plot.png\n";
  const Stage alive = makeStage(out_.parent_path(), "other");
  std::ofstream(alive.path / "a.csv") << "of another process";
  write("2", Earlier::Replace);
  EXPECT_EQ(test::readAll(other / "a.csv"), "new");
  EXPECT_FALSE(std::filesystem::exists(other / "plot.png"));
  EXPECT_FALSE(std::filesystem::exists(complete));
  EXPECT_EQ(test::readAll(alive.path / "a.csv"), "of another process");
}

// what others keep under such names, as claims of a sweep
TEST_F(LeftBehind, LeavesWhatIsNoStage)
{
  const std::filesystem::path beside = out_.parent_path();
  for (const char* name : { ".palp-abcdef", ".out.palp-abcdefg", "out.palp-abcdef", ".palp-file" })
  {
    std::filesystem::create_directories(beside / name);
  }
  std::ofstream(beside / ".out.palp-ABCDEF") << "a file";
  std::filesystem::create_directory_symlink(folder_.path(), beside / ".out.palp-linked");
  write("1");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(beside), {}), 7);
}

} // namespace
} // namespace palp
