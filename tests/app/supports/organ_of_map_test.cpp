#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace palp
{
namespace
{

// of a map that is the same everywhere a body is as of one modulus; the file is of that map only
TEST(OrganOfMap, AFileOfAMapIsFeltWithThatMap)
{
  const test::TemporaryFolder folder;
  const auto make = [&](const std::string& name, const std::string& more)
  {
    return test::runCommand(PALP_PROGRAM " organ " PALP_SHARE "/meshes/block_50.vtp --cell 16mm "
                                         "--poisson 0.45 --support bonded:direction:0,0,-1:30deg" +
      more + " --out " + (folder.path() / name).string());
  };
  const auto run = [&](const std::string& name, const std::string& more)
  {
    return test::runCommand(PALP_PROGRAM " run " PALP_SHARE "/meshes/block_50.vtp --at 10,5,0 "
                                         "--depth 4mm --law corrected --poisson 0.45 "
                                         "--samples-only --overwrite --out " +
      (folder.path() / "pressed").string() + " --organ " + (folder.path() / name).string() + more);
  };
  const auto force = [&]
  {
    const std::vector<double> all =
      test::readCsv(folder.path() / "pressed" / "samples.csv")["force_N"];
    return *std::ranges::max_element(all);
  };
  ASSERT_EQ(make("even.organ", "").code, 0);
  ASSERT_EQ(run("even.organ", " --young 5kPa").code, 0);
  const double even = force();
  // made by another modulus than it is felt with, for the map has its own
  ASSERT_EQ(make("map.organ", " --stiffness formula:5 --young 20kPa").code, 0);
  const test::Finished felt = run("map.organ", " --stiffness formula:5");
  ASSERT_EQ(felt.code, 0) << felt.err;
  const double mapped = force();
  EXPECT_NEAR(mapped, even, 5e-3 * even);
  for (const char* young : { "1kPa", "200kPa" })
  {
    ASSERT_EQ(run("map.organ", std::string(" --stiffness formula:5 --young ") + young).code, 0);
    EXPECT_NEAR(force(), mapped, 1e-6 * mapped) << young;
  }
  for (const char* other : { " --stiffness formula:6", "" })
  {
    const test::Finished refused = run("map.organ", other);
    EXPECT_EQ(refused.code, 2) << other;
    EXPECT_NE(refused.err.find("whose stiffness is formula:5"), std::string::npos) << refused.err;
  }
}

TEST(OrganOfMap, TellsNoSinglePlaceOfABodyWithAMap)
{
  const test::Finished told = test::runCommand(
    PALP_PROGRAM " organ --cell 20mm --support posterior --stiffness formula:5 --at 0,0,0");
  EXPECT_EQ(told.code, 2);
  EXPECT_NE(told.err.find("--stiffness: give --out"), std::string::npos) << told.err;
}

} // namespace
} // namespace palp
