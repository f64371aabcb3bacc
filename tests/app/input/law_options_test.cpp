#include "tests/support/printed_table.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using test::Finished;

Finished force(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " force --young 50kPa --poisson 0.33 " + arguments);
}

// eight digits of the integral equation for a bonded layer of 30 mm, data/reference
TEST(LawOptions, CorrectedSphereOnALayer)
{
  const auto law = test::printedTable(
    force("--tip sphere:6mm --law corrected --material linear --thickness 30mm --depth 1:6:5mm"));
  EXPECT_NEAR(law["force_N"][0], 0.19416921, 1e-6);
  EXPECT_NEAR(law["force_N"][1], 2.851754, 1e-5);
  EXPECT_NEAR(law["factor_shape"][1], 2.4233212 / 2.6933004, 1e-6);
  EXPECT_NEAR(law["factor_thickness"][1], 2.851754 / 2.4233212, 1e-5);
  EXPECT_EQ(law["factor_curvature"][1], 1.0);
}

TEST(LawOptions, ExactSphereIsSneddons)
{
  const auto law = test::printedTable(force("--tip sphere:6mm --law exact --depth 6:6:1mm"));
  EXPECT_NEAR(law["force_N"][0], 2.4233212, 1e-6);
}

TEST(LawOptions, SlippingBaseIsSofter)
{
  const std::string position = "--tip sphere:6mm --law corrected --thickness 20mm --depth 5:5:1mm ";
  EXPECT_LT(test::printedTable(force(position + "--base slip"))["force_N"][0],
    test::printedTable(force(position))["force_N"][0]);
}

// finite elements, data/reference: 0.199 N and 2.957 N, within 3 %
TEST(LawOptions, NeoHookeanSphereIsThatOfFiniteElements)
{
  const auto law =
    test::printedTable(force("--tip sphere:6mm --law corrected --thickness 30mm --depth 1:6:5mm"));
  EXPECT_NEAR(law["force_N"][0], 0.1990, 0.03 * 0.1990);
  EXPECT_NEAR(law["force_N"][1], 2.957, 0.03 * 2.957);
  EXPECT_NEAR(law["factor_large_strain"][1], 1.038, 0.01);
}

// Hertz: R R0 / (R + R0) for the paraboloid
TEST(LawOptions, CurvedSurfaceIsHertz)
{
  const auto law = test::printedTable(
    force("--tip paraboloid:10mm --law corrected --surface-radius 40mm --depth 1:1:1mm"));
  EXPECT_NEAR(law["factor_curvature"][0], std::sqrt(0.8), 1e-6);
  const auto saddle = test::printedTable(
    force("--tip paraboloid:10mm --law corrected --surface-radius 40mm:-40mm --depth 1:1:1mm"));
  EXPECT_EQ(saddle["factor_curvature"][0], 1.0);
  EXPECT_GT(saddle["factor_ellipse"][0], 1.0);
}

// boundary elements: 1.04452 at 9 degrees
TEST(LawOptions, TiltedConeIsThatOfTheBoundaryElements)
{
  const auto law =
    test::printedTable(force("--tip cone:45deg:10mm --law corrected --tilt 9deg --depth 2:2:1mm"));
  EXPECT_NEAR(law["factor_inclination"][0], 1.04452, 1e-5);
  EXPECT_NEAR(law["lateral_force_N"][0] / law["axial_force_N"][0],
    std::tan(9.0 * std::numbers::pi / 180.0), 1e-9);
}

TEST(LawOptions, EveryToolIsUnderstood)
{
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "tool.csv";
  std::ofstream(file) << "radius_mm,height_mm\n0,0\n2,0\n10,8\n";
  for (const std::string tip : { "sphere:10mm", "cone:45deg:10mm", "punch:5mm",
         "truncated-cone:45deg:2mm:10mm", "blunt-cone:45deg:0.3mm:10mm", "paraboloid:10mm" })
  {
    EXPECT_GT(test::printedTable(force("--depth 3:3:1mm --tip " + tip))["force_N"][0], 0.1) << tip;
  }
  // a profile in the shape of the truncated cone
  EXPECT_NEAR(
    test::printedTable(force("--depth 3:3:1mm --tip profile:" + file.string()))["force_N"][0],
    test::printedTable(force("--depth 3:3:1mm --tip truncated-cone:45deg:2mm:10mm"))["force_N"][0],
    1e-6);
}

TEST(LawOptions, PaperStaysThePapersWhateverThePlace)
{
  const Finished bare = force("--tip sphere:6mm --depth 0:6:1mm");
  const Finished position = force("--tip sphere:6mm --depth 0:6:1mm --thickness 10mm --tilt 9deg");
  EXPECT_EQ(bare.out, position.out);
  EXPECT_NE(position.err.find("--law corrected"), std::string::npos);
}

TEST(LawOptions, TellsWhichFactorsAct)
{
  const Finished finished =
    force("--tip sphere:6mm --law corrected --material linear --thickness 30mm --depth 6:6:1mm");
  EXPECT_NE(finished.err.find("shape x0.8998, thickness x1.1768"), std::string::npos)
    << finished.err;
}

TEST(LawOptions, ValidityIsAColumnForEachRule)
{
  const auto law = test::printedTable(force("--tip sphere:10mm --depth 2:10:8mm --validity"));
  EXPECT_LT(law["force_of_itself_of_limit"][0], 1.0);
  EXPECT_GT(law["force_of_itself_of_limit"][1], 1.0);
  EXPECT_EQ(law.comments.size(), 14U);
}

TEST(LawOptions, RefusesWhatMakesNoSense)
{
  for (const char* arguments : { "--law hertz", "--base wet", "--material jelly" })
  {
    EXPECT_EQ(force(arguments).code, 2) << arguments;
    EXPECT_EQ(force(arguments).out, "") << arguments;
  }
  for (const char* arguments : { "--thickness 0mm", "--thickness 30", "--surface-radius 0mm",
         "--surface-radius 50mm:", "--tilt 95deg", "--tip profile:/no/such/file.csv",
         "--tip profile:" })
  {
    const Finished finished = force(arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_EQ(finished.out, "") << arguments;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

TEST(LawOptions, CoatingsActOnTheCorrectedLawOnly)
{
  const auto at2mm = [](const std::string& options)
  { return force("--depth 2:2:1mm --law corrected --material linear " + options); };
  const double plain = test::printedTable(at2mm(""))["force_N"][0];
  const auto same = test::printedTable(at2mm("--coating 2mm:50kPa:0.33"));
  EXPECT_NEAR(same["force_N"][0], plain, 1e-3 * plain);
  const auto skin = test::printedTable(at2mm("--coating 2mm:250kPa:0.33"));
  EXPECT_GT(skin["force_N"][0], 1.1 * plain);
  EXPECT_NEAR(skin["factor_coatings"][0], skin["force_N"][0] / plain, 1e-9);
  EXPECT_EQ(at2mm("").out.find("factor_coatings"), std::string::npos);

  const std::string corrected = "--law corrected --coating ";
  for (const std::string& wrong : { std::string("--coating 2mm:50kPa:0.45"),
         std::string("--law exact --coating 2mm:50kPa:0.45"), corrected + "2mm:50kPa",
         corrected + "2mm:50:0.45", corrected + "0.01mm:50kPa:0.45", corrected + "2mm:50MPa:0.45" })
  {
    const Finished refused = force(wrong);
    EXPECT_EQ(refused.code, 2) << wrong;
    EXPECT_NE(refused.err.find("coating"), std::string::npos) << refused.err;
    EXPECT_TRUE(refused.out.empty()) << refused.out;
  }
}

} // namespace
} // namespace palp
