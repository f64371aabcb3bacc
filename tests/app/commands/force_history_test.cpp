#include "tests/haptics/force/reference_table.h"
#include "tests/support/printed_table.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using test::Finished;

Finished force(const std::string& arguments, const std::string& history)
{
  return test::runCommand(
    PALP_PROGRAM " force --history " + test::writtenCsv(history).string() + " " + arguments);
}

// Ting's solution by another program; the corrected law of a paraboloid on a half-space is Hertz's
TEST(ForceHistory, FollowsTing)
{
  const auto rows = test::referenceTable("visco_ramp_v20");
  ASSERT_GT(rows.size(), 1000u);
  std::string history = "time_s,depth_mm\n";
  double strongest = 0.0;
  for (const auto& row : rows)
  {
    history += row.text("t_s") + "," + std::to_string(1e3 * row.number("d_m")) + "\n";
    strongest = std::max(strongest, row.number("F_N"));
  }
  const Finished finished = force("--tip paraboloid:10mm --young 20kPa --poisson 0.45 --law "
                                  "corrected --material linear --relaxation 0.5:200ms",
    history);
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_TRUE(finished.out.starts_with("time_s,depth_mm,force_N\n"));
  const std::vector<double> forces = test::printedTable(finished)["force_N"];
  ASSERT_EQ(forces.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const bool loading = rows[i].number("t_s") < 0.3;
    EXPECT_NEAR(forces[i], rows[i].number("F_N"), (loading ? 2e-4 : 1e-3) * strongest) << i;
  }
}

TEST(ForceHistory, IsTheElasticLawWithoutRelaxation)
{
  const std::string options = "--tip sphere:10mm --young 5kPa --law corrected --thickness 30mm ";
  const Finished over = force(options, "time_s,depth_mm\n0,1\n0.5,4\n0.6,-1\n2,4\n");
  ASSERT_EQ(over.code, 0) << over.err;
  const Finished law = test::runCommand(PALP_PROGRAM " force --depth 1:4:3mm " + options);
  const std::vector<double> known = test::printedTable(law)["force_N"];
  EXPECT_EQ(
    test::printedTable(over)["force_N"], (std::vector{ known[0], known[1], 0.0, known[1] }));
}

TEST(ForceHistory, RelaxesFromTheInstantaneousToTheLastingForceWhateverTheTip)
{
  for (const char* tip :
    { "cone:45deg:10mm", "punch:5mm", "sphere:10mm", "blunt-cone:60deg:3mm:10mm" })
  {
    const std::string options =
      std::string("--tip ") + tip + " --young 5kPa --law corrected --thickness 30mm ";
    const Finished held =
      force(options + "--relaxation 0.3:50ms,0.2:1s", "time_s,depth_mm\n0,4\n100,4\n101,0\n");
    ASSERT_EQ(held.code, 0) << held.err;
    const Finished law = test::runCommand(PALP_PROGRAM " force --depth 4:4:1mm " + options);
    const double elastic = test::printedTable(law)["force_N"][0];
    const std::vector<double> forces = test::printedTable(held)["force_N"];
    EXPECT_NEAR(forces[0], elastic, 1e-9 * elastic) << tip;
    EXPECT_NEAR(forces[1], 0.5 * elastic, 1e-9 * elastic) << tip;
    EXPECT_EQ(forces[2], 0.0) << tip;
  }
}

// Where all that lies below relaxes alike, the elastic force of a press that only goes deeper is
// remembered as that of tissue without a nodule is: Lee and Radok's integral, here by its sum.
void expectLeeAndRadok(const std::string& options)
{
  constexpr double kFraction = 0.5;
  constexpr double kTime = 0.2; // [s]
  constexpr int kDown = 500;    // rows of 1 ms, 0.01 mm deeper each
  std::string history = "time_s,depth_mm\n";
  for (int i = 0; i <= 2 * kDown; ++i)
  {
    history += std::to_string(1e-3 * i) + "," + std::to_string(0.01 * std::min(i, kDown)) + "\n";
  }
  const Finished over = force(options + " --relaxation 0.5:200ms", history);
  ASSERT_EQ(over.code, 0) << over.err;
  const std::vector<double> forces = test::printedTable(over)["force_N"];
  const std::vector<double> elastic = test::printedTable(
    test::runCommand(PALP_PROGRAM " force --depth 0:5:0.01mm " + options))["force_N"];
  ASSERT_EQ(forces.size(), 2u * kDown + 1u);
  ASSERT_EQ(elastic.size(), kDown + 1u);
  for (int i = 1; i <= 2 * kDown; i += 7)
  {
    double expected = 0.0;
    for (int k = 1; k <= std::min(i, kDown); ++k)
    {
      const double ago = 1e-3 * (i - k + 0.5);
      expected +=
        (1.0 - kFraction * (1.0 - std::exp(-ago / kTime))) * (elastic[k] - elastic[k - 1]);
    }
    ASSERT_NEAR(forces[i], expected, 2e-4 * elastic.back()) << options << ", row " << i;
  }
}

TEST(ForceHistory, RemembersANoduleAndAMapAsLeeAndRadokDo)
{
  for (const char* below : { "--nodule 5mm:5mm:10:3mm", "--nodule 4mm:3mm:0.2",
         "--nodule 6mm:4mm:5 --nodule 4mm:6mm:0.3:12mm", "--stiffness 'formula:if(z<2,15,5)'",
         "--stiffness 'formula:5+0.4*z'" })
  {
    expectLeeAndRadok(
      "--young 5kPa --poisson 0.45 --law corrected --thickness 40mm " + std::string(below));
  }
}

// the stiffness of which falls with depth: by large strain, by a map, by a soft nodule
TEST(ForceHistory, RemembersWhatASofteningPressDoesAsLeeAndRadokDo)
{
  for (const char* press : { "--tip punch:4mm", "--tip punch:10mm --thickness 60mm",
         "--tip truncated-cone:60deg:4mm:10mm --thickness 40mm --stiffness 'formula:if(z<4,40,20)'",
         "--tip punch:4mm --material linear --thickness 40mm --nodule 5mm:4mm:.3" })
  {
    expectLeeAndRadok(
      "--young 5kPa --poisson 0.45 --law corrected --base bonded " + std::string(press));
  }
}

// no time to relax, and then all of it
TEST(ForceHistory, BeginsAndEndsAsTheLawWhateverLiesBelow)
{
  for (const std::string tip : { "punch:4mm", "punch:10mm", "truncated-cone:60deg:4mm:10mm",
         "sphere:8mm", "paraboloid:8mm", "cone:45deg:10mm", "blunt-cone:45deg:2mm:10mm" })
  {
    for (const std::string below :
      { "", "--thickness 40mm", "--surface-radius 50mm --tilt 8deg", "--material linear",
        "--coating 2mm:30kPa:0.45", "--thickness 40mm --nodule 5mm:4mm:.3",
        "--nodule 5mm:4mm:8:3mm --nodule 3mm:9mm:0.3:12mm", "--stiffness 'formula:if(z<4,40,20)'",
        "--thickness 40mm --stiffness 'formula:if(r<4,60,25)'" })
    {
      std::string options = "--law corrected --base bonded --young 20kPa --poisson .45 --tip ";
      options += tip + " " + below;
      const Finished over =
        force(options + " --relaxation 0.3:1s", "time_s,depth_mm\n0,3\n100,3\n");
      ASSERT_EQ(over.code, 0) << options << over.err;
      const std::vector<double> forces = test::printedTable(over)["force_N"];
      const double law = test::printedTable(
        test::runCommand(PALP_PROGRAM " force --depth 3:3:1mm " + options))["force_N"][0];
      EXPECT_NEAR(forces[0], law, 1e-9 * law) << options;
      EXPECT_NEAR(forces[1], 0.7 * law, 1e-9 * law) << options;
    }
  }
}

TEST(ForceHistory, TakesColumnsAmongOthers)
{
  const Finished finished = force("--law corrected", "force_N,depth_mm,time_s\n7,1,0\n8,2,1\n");
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(test::printedTable(finished)["time_s"], (std::vector{ 0.0, 1.0 }));
}

void expectRefusal(const Finished& finished, const std::string& what)
{
  EXPECT_EQ(finished.code, 2) << what;
  EXPECT_NE(finished.err.find(what), std::string::npos) << finished.err;
  EXPECT_EQ(test::sentences(finished).size(), 1U) << finished.err;
}

TEST(ForceHistory, RefusesTermsThatNoTissueHas)
{
  const auto refuse = [](const std::string& terms, const std::string& what)
  {
    expectRefusal(
      force("--law corrected --relaxation " + terms, "time_s,depth_mm\n0,0\n1,1\n"), what);
  };
  refuse("0.6:1s,0.5:2s", "--relaxation: the fractions add up to 1 or more");
  refuse("1:1s", "add up to 1 or more");
  refuse("0:1s", "--relaxation: a fraction is not above 0");
  refuse("0.3:1s,-0.2:1s", "--relaxation: a fraction is not above 0");
  refuse("nan:1s", "--relaxation");
  refuse("0.5:-1s", "--relaxation: a time is out of range");
  refuse("0.5:0s", "--relaxation: a time is out of range");
  refuse("0.5:1", "--relaxation");
  refuse("0.5:10mm", "--relaxation");
  refuse("0.5", "has not the form");
  refuse("0.5:1s,", "has not the form");
  refuse("0.1:1s,0.1:2s,0.1:3s,0.1:4s,0.1:5s,0.1:6s,0.1:7s", "--relaxation: more than 6 terms");
}

TEST(ForceHistory, RefusesTheOtherLawsByName)
{
  for (const std::string law : { "paper", "exact" })
  {
    expectRefusal(force("--law " + law + " --relaxation 0.5:1s", "time_s,depth_mm\n0,0\n1,1\n"),
      "--relaxation: the law '" + law + "' knows none");
  }
}

TEST(ForceHistory, RefusesRelaxationWithoutTime)
{
  expectRefusal(
    test::runCommand(PALP_PROGRAM " force --law corrected --relaxation 0.5:1s"), "add --history");
}

TEST(ForceHistory, RefusesHistoriesThatAreNone)
{
  const auto refuse = [](const std::string& history, const std::string& what)
  { expectRefusal(force("--law corrected --relaxation 0.5:1s", history), what); };
  refuse("time_s,depth_mm\n0,0\n1,1\n1,2\n", ":4: time_s is 1 after 1; give times that increase");
  refuse("time_s,depth_mm\n1,0\n0.5,1\n", ":3: time_s is 0.5 after 1");
  refuse("time_s,depth_mm\n-1,0\n0.5,1\n", ":2: time_s is -1; give times of 0 or more");
  refuse("time_s,depth_mm\n0,0\n0.5,nan\n", ":3: not finite");
  refuse("time_s,depth_mm\n0,0\ninf,1\n", ":3: not finite");
  refuse("time_s,depth_mm\n0,0\n0.5,2000\n", ":3: depth_mm is 2000; give -1000 to 1000");
  refuse("time_s,depth_mm\n0,0\n0.5,deep\n", "is not a number");
  refuse("time_s,depth_mm\n", "no row below the header");
  refuse("time_s,depth\n0,1\n", "no column depth_mm");
  refuse("", "no column");
}

} // namespace
} // namespace palp
