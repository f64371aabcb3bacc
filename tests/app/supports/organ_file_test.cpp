#include "tests/support/process.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(OrganFile, IsMadeAnewWhereWhatItGoesOnFromIsDamaged)
{
  const test::TemporaryFolder folder;
  const std::filesystem::path organ = folder.path() / "block.organ";
  const std::filesystem::path part = folder.path() / "block.organ.part";
  const auto make = [&](const std::string& more = "")
  {
    return test::runCommand(PALP_PROGRAM " organ " PALP_SHARE
                                         "/meshes/block_50.vtp --cell 25mm --support "
                                         "bonded:direction:0,0,-1:30deg --out " +
      organ.string() + more);
  };
  ASSERT_EQ(make().code, 0);
  const std::string whole = test::readAll(organ);
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 1;
  for (const std::string& damaged : { std::string(), whole.substr(0, whole.size() / 3), flipped })
  {
    std::filesystem::remove(organ);
    std::ofstream(part) << damaged;
    const test::Finished made = make();
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.err.find(part.string() + ": is damaged"), std::string::npos) << made.err;
    EXPECT_EQ(test::readAll(organ), whole);
    EXPECT_FALSE(std::filesystem::exists(part));
  }
  std::ofstream(organ) << flipped;
  EXPECT_EQ(make().code, 2) << "a finished file may have been edited by hand";
  EXPECT_EQ(make(" --overwrite").code, 0);
  EXPECT_EQ(test::readAll(organ), whole);
}

} // namespace
} // namespace palp
