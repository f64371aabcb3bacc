#include "calibration/csv_rows.h"
#include "calibration/csv_text.h"
#include "haptics/error.h"

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
  Csv()
  {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }

  [[nodiscard]] std::string refusal(const std::string& text) const
  {
    std::ofstream(file_) << text;
    try
    {
      (void)readCsv(file_, 2);
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.code(), ErrorCode::BadFile);
      return std::string(error.what()).substr(file_.string().size());
    }
    return "accepted";
  }

  [[nodiscard]] std::ptrdiff_t filesBeside() const
  {
    return std::distance(std::filesystem::directory_iterator(folder_), {});
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
    ("csv_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  std::filesystem::path file_ = folder_ / "table.csv";
};

TEST_F(Csv, RowsAreThoseBelowTheHeader)
{
  std::ofstream(file_) << "# a comment\r\n\r\na_mm,b\r\n1,2.5\r\n# another\r\n-3,4e-1\r\n";
  EXPECT_EQ(readCsv(file_, 2), (std::vector<std::vector<double>>{ { 1.0, 2.5 }, { -3.0, 0.4 } }));
}

TEST_F(Csv, RowsWithoutAHeaderAreRefused)
{
  const std::string none = ": no header; begin with the names of 2 columns";
  EXPECT_EQ(refusal("1,2\n3,4\n"), none);
  EXPECT_EQ(refusal("-1,2\n3,4\n"), none);
  EXPECT_EQ(refusal("a,b,c\n"), none);
  EXPECT_EQ(refusal(""), none);
}

TEST_F(Csv, RowsOfOtherContentsAreRefusedWithTheLine)
{
  EXPECT_EQ(refusal("a,b\n1,2\n3,x\n"), ":3: 'x' is not a number; give a,b");
  EXPECT_EQ(refusal("a,b\n1,2,3\n"), ":2: 3 columns; give a,b");
  EXPECT_EQ(refusal("a,b\n1,nan\n"), ":2: not finite; give numbers");
  EXPECT_THROW((void)readCsv(folder_ / "none.csv", 2), Error);
}

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
