#include "tests/haptics/files/output_rig.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

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
  const std::filesystem::path abandoned = out_ / ".palp-file-abcdef";
  std::filesystem::create_directories(abandoned);
  clearAbandoned(out_);
  EXPECT_TRUE(std::filesystem::exists(abandoned)) << "it may be locked in a moment";
  std::filesystem::last_write_time(abandoned, agesAgo);
  clearAbandoned(out_);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out_), {}), 3);
}

} // namespace
} // namespace palp
