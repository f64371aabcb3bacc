#include "tests/app/supports/slabs.h"
#include "tests/support/process.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

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

// a plate that is held at one end: 16 times too stiff if it were felt as a half-space
TEST(OrganFile, IsNotWrittenWhereNoPlaceIsAnswered)
{
  const test::TemporaryFolder folder;
  const std::filesystem::path plate = folder.path() / "plate.obj";
  test::writeBox(plate, { 0.0, -11.0, -16.0 }, { 48.0, 11.0, 0.0 });
  const auto make = [&](const std::string& cell)
  {
    return test::runCommand(PALP_PROGRAM " organ " + plate.string() +
      " --unit mm --support bonded:direction:1,0,0:5deg --cell " + cell + " --out " +
      (folder.path() / "plate.organ").string());
  };
  const test::Finished coarse = make("8mm");
  EXPECT_EQ(coarse.code, 2) << coarse.err;
  EXPECT_NE(coarse.err.find("give smaller cells"), std::string::npos) << coarse.err;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  EXPECT_EQ(make("4mm").code, 0);
}

} // namespace
} // namespace palp
