#include "calibration/csv_text.h"
#include "tests/support/process.h"

#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace palp
{
namespace
{

class Csv : public testing::Test
{
protected:
  [[nodiscard]] std::ptrdiff_t filesBeside() const
  {
    return std::distance(std::filesystem::directory_iterator(folder_), {});
  }

  std::filesystem::path folder_ = test::freshFolder();
  std::filesystem::path file_ = folder_ / "table.csv";
};

TEST_F(Csv, AFileIsReplacedWhole)
{
  std::ofstream(file_) << "a longer text than the next";
  EXPECT_TRUE(replaceFile(file_, "short"));
  std::ostringstream text;
  text << std::ifstream(file_).rdbuf();
  EXPECT_EQ(text.str(), "short");
  EXPECT_EQ(filesBeside(), 1);
}

// a folder of the file's name refuses to be replaced, a full disk to be written
TEST_F(Csv, NothingIsLeftOfAFileThatCannotBeReplaced)
{
  std::filesystem::create_directories(file_ / "full");
  EXPECT_FALSE(replaceFile(file_, "text"));
  EXPECT_EQ(filesBeside(), 1);
  if (std::filesystem::exists("/dev/full"))
  {
    std::filesystem::create_symlink("/dev/full", folder_ / "other.csv.new");
    EXPECT_FALSE(replaceFile(folder_ / "other.csv", std::string(100'000, 'x')));
    EXPECT_EQ(filesBeside(), 1);
  }
}

} // namespace
} // namespace palp
