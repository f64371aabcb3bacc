#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <sstream>
#include <vector>

namespace palp
{
namespace
{

// the remark of each row
std::vector<std::string> remarks(const std::string& options)
{
  const test::Finished run = test::runCommand(
    PALP_PROGRAM " organ " PALP_SHARE "/meshes/block_50.vtp --cell 10mm " + options);
  EXPECT_EQ(run.code, 0) << run.err;
  std::vector<std::string> all;
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line))
  {
    all.push_back(line.substr(line.rfind(',') + 1));
  }
  return all;
}

// the block of 100 x 100 x 50 mm, its top at z = 0
TEST(OrganCommand, RemarksWhatItCannotTell)
{
  const std::string below = "--support bonded:box:-60,-60,-55:60,60,-45 ";
  EXPECT_EQ(remarks(below + "--at 0,0,0 --depth 2:4:2mm"), std::vector<std::string>(2));
  const auto deep = remarks(below + "--at 0,0,0 --depth 10:70:30mm");
  ASSERT_EQ(deep.size(), 3U);
  EXPECT_EQ(deep.back(), "too deep");
  EXPECT_EQ(remarks(below + "--at 45,0,0 --depth 2:2:1mm").at(0), "edge");
  EXPECT_EQ(
    remarks(below + "--support bonded:box:-15,-15,-5:15,15,5 --at 0,0,0 --depth 1:1:1mm").at(0),
    "on a support");
}

} // namespace
} // namespace palp
