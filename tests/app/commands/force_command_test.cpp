#include "tests/support/printed_table.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using test::Finished;

Finished palpCommand(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " " + arguments);
}

TEST(ForceCommand, PrintsHertzForTheSphere)
{
  const Finished finished =
    palpCommand("force --tip sphere:10mm --young 50kPa --poisson 0.33 --depth 0:10:0.5mm");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const test::CsvTable law = test::printedTable(finished);
  ASSERT_EQ(law["depth_mm"].size(), 21u);
  for (std::size_t i = 0; i < 21; ++i)
  {
    EXPECT_EQ(law["depth_mm"][i], 0.5 * static_cast<double>(i));
    const double depth = 0.0005 * static_cast<double>(i);
    const double modulus = 50e3 / (1.0 - 0.33 * 0.33);
    const double radius = std::sqrt(0.01 * depth);
    EXPECT_NEAR(law["force_N"][i], 4.0 / 3.0 * modulus * radius * depth, 1e-12);
    EXPECT_NEAR(law["contact_radius_mm"][i], 1e3 * radius, 1e-12);
    EXPECT_NEAR(law["stiffness_N_per_mm"][i], 2e-3 * modulus * radius, 1e-12);
  }
}

TEST(ForceCommand, PrintsSneddonForTheConeByTheAngleFromTheAxis)
{
  // at 45 degrees both readings of the angle agree; at 30 they differ threefold
  const test::CsvTable law = test::printedTable(
    palpCommand("force --tip cone:30deg:10mm --young 50kPa --poisson 0.33 --depth 5:5:1mm"));
  const double modulus = 50e3 / (1.0 - 0.33 * 0.33);
  ASSERT_EQ(law["force_N"].size(), 1u);
  EXPECT_NEAR(law["force_N"][0],
    2.0 / std::numbers::pi * modulus * std::tan(std::numbers::pi / 6.0) * 25e-6, 1e-12);
}

TEST(ForceCommand, TellsThatItsOutputWasLost)
{
  const Finished finished = palpCommand("force --tip sphere:10mm --depth 0:10:0.5mm > /dev/full");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.err.find("cannot be written"), std::string::npos) << finished.err;
}

TEST(ForceCommand, RefusesABareModulusInOneLine)
{
  const Finished finished = palpCommand("force --young 50");
  EXPECT_EQ(finished.code, 2);
  EXPECT_EQ(finished.out, "");
  EXPECT_EQ(finished.err, "palp: --young: '50' has no unit; write 50kPa (kPa, Pa, MPa, GPa)\n");
}

TEST(ForceCommand, RefusesWhatIsOutOfRange)
{
  for (const char* arguments :
    { "--young 0.5Pa", "--young 11GPa", "--poisson 0.51", "--poisson -0.1", "--tip sphere:0.05mm",
      "--tip sphere:1.1m", "--tip cone:0.5deg:10mm", "--tip cone:90deg:10mm", "--tip egg:3mm",
      "--tip sphere", "--depth 3:1:1mm", "--depth 0:1e300:1e299mm", "--depth 1e300:1e300:1mm",
      "--depth -1:3:1mm", "--law corrected --tilt -10deg" })
  {
    const Finished finished = palpCommand(std::string("force ") + arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_EQ(finished.out, "") << arguments;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

// of a body as thick as they are nothing is left
TEST(ForceCommand, RefusesCoatingsAsThickAsTheBody)
{
  const std::string coated =
    "force --law corrected --depth 1:2:1mm --coating 4mm:20kPa:0.45,6mm:5kPa:0.45 --thickness ";
  for (const char* thin : { "5mm", "10mm" })
  {
    const Finished finished = palpCommand(coated + thin);
    EXPECT_EQ(finished.code, 2) << thin;
    EXPECT_NE(finished.err.find("coatings: of 10 mm"), std::string::npos) << finished.err;
  }
  EXPECT_EQ(palpCommand(coated + "15mm").code, 0);
}

TEST(ForceCommand, WarnsWhereTheLawIsOutsideItsLimits)
{
  const Finished deep = palpCommand(
    "force --law corrected --thickness 1mm --depth 10:10:1mm"); // deeper than it is thick
  EXPECT_EQ(deep.code, 0);
  EXPECT_NE(deep.err.find("outside its limits"), std::string::npos) << deep.err;
  EXPECT_EQ(palpCommand("force --depth 1:1:1mm").err.find("outside"), std::string::npos);
}

TEST(ViewCommand, TellsAWrongValueBeforeAMissingDisplay)
{
  const Finished finished = test::runCommand("env -u DISPLAY " PALP_PROGRAM " --tip sphere:10");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.err.find("has no unit"), std::string::npos) << finished.err;
}

TEST(ViewCommand, SaysWhatToDoWithoutADisplay)
{
  const Finished finished =
    test::runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " PALP_PROGRAM " view");
  EXPECT_EQ(finished.code, 4);
  EXPECT_NE(finished.err.find("palp run"), std::string::npos) << finished.err;
}

TEST(ForceCommand, HelpTeachesByExample)
{
  const Finished finished = palpCommand("force --help");
  EXPECT_EQ(finished.code, 0);
  EXPECT_NE(finished.out.find("palp force --tip"), std::string::npos);
}

// rows of data/reference/nodule_offaxis.csv: linear finite elements
TEST(ForceCommand, FeelsANoduleBesideTheTool)
{
  const std::string body = "force --tip sphere:10mm --young 50kPa --poisson 0.33 --law corrected "
                           "--material linear --thickness 30mm ";
  const auto at = [&](const std::string& options)
  { return test::printedTable(palpCommand(body + "--depth 0:4:2mm " + options)); };
  struct Row
  {
    const char* nodule;
    std::size_t depth;
    double force;
    double lateral;
  };
  for (const Row& row : { Row{ "5mm:5mm:5", 1, 0.8561874, 0.0 },
         { "5mm:5mm:5:5mm", 2, 2.405091, 0.0484034 }, { "5mm:5mm:5:10mm", 2, 2.280519, 0.026565 } })
  {
    const test::CsvTable felt = at(std::string("--nodule ") + row.nodule);
    EXPECT_NEAR(felt["force_N"][row.depth], row.force, 0.01 * row.force);
    EXPECT_NEAR(felt["lateral_force_N"][row.depth], row.lateral, 0.002 * row.force);
  }
  const test::CsvTable plain = at("");
  EXPECT_EQ(plain.columns.count("factor_nodules"), 0U);
  const test::CsvTable far = at("--nodule 5mm:5mm:5:200mm");
  EXPECT_NEAR(far["force_N"][2], plain["force_N"][2], 1e-4 * plain["force_N"][2]);
  EXPECT_GT(at("--nodule 5mm:5mm:5 --nodule 2mm:15.5mm:5")["force_N"][2],
    at("--nodule 5mm:5mm:5")["force_N"][2]);
}

TEST(ForceCommand, RefusesNodulesThatCannotBe)
{
  const std::string corrected = "--law corrected --thickness 30mm ";
  for (const std::string& wrong :
    { std::string("--nodule 5mm:5mm:5"), std::string("--law exact --nodule 5mm:5mm:5"),
      corrected + "--nodule 5mm:5mm", corrected + "--nodule 5:5mm:5",
      corrected + "--nodule 5mm:5mm:0", corrected + "--nodule 5mm:5mm:-2",
      corrected + "--nodule 5mm:5mm:nan", corrected + "--nodule 5mm:-1mm:5",
      corrected + "--nodule 5mm:25mm:5", corrected + "--nodule 5mm:5mm:5:-3mm",
      corrected + "--nodule 5mm:5mm:5:3mm:1", corrected + "--nodule 5mm:5mm:5 --nodule 3mm:12mm:5",
      corrected + "--coating 2mm:50kPa:0.45 --nodule 5mm:5mm:5" })
  {
    const Finished refused = palpCommand("force " + wrong);
    EXPECT_EQ(refused.code, 2) << wrong;
    EXPECT_NE(refused.err.find("--nodule"), std::string::npos) << refused.err;
    EXPECT_TRUE(refused.out.empty()) << refused.out;
  }
  EXPECT_NE(palpCommand("force --nodule 5mm:5mm:5").err.find("'paper'"), std::string::npos);
}

TEST(ForceCommand, TellsAtOnceAllThatTheLawDoesNotTake)
{
  const auto refused = [](const std::string& options)
  { return palpCommand("force --law exact --relaxation " + options).err; };
  EXPECT_EQ(refused("0.3:50ms --nodule 5mm:5mm:5 --coating 2mm:50kPa:0.45 --stiffness formula:6"),
    "palp: --coating, --relaxation, --nodule, --stiffness: the law 'exact' knows none of these; "
    "take the law 'corrected' and, to relax over time, --history FILE.csv with columns time_s and "
    "depth_mm, or leave them out\n");
  EXPECT_EQ(refused("0.3:50ms"),
    "palp: --relaxation: the law 'exact' knows none; take the law 'corrected' and, to relax over "
    "time, --history FILE.csv with columns time_s and depth_mm, or leave it out\n");
  EXPECT_EQ(refused("0.3:0.05"),
    "palp: --relaxation: '0.05' has no unit; write 0.05s (s, ms); and take the law 'corrected', as "
    "'exact' knows none\n");
  EXPECT_EQ(palpCommand("force --relaxation 0.3:0.05 --law corrected").err,
    "palp: --relaxation: '0.05' has no unit; write 0.05s (s, ms)\n");
}

} // namespace
} // namespace palp
