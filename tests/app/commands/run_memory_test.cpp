#include "tests/app/commands/run_rig.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

using namespace test;

constexpr const char* kTissue =
  " --tip sphere:10mm --young 20kPa --poisson 0.45 --law corrected --material linear ";

// of a file of samples, without the line that names the command
std::string bytesOf(const std::filesystem::path& file)
{
  std::istringstream text(readAll(file));
  std::string kept;
  for (std::string line; std::getline(text, line);)
  {
    kept += line.starts_with("# command") ? "" : line + "\n";
  }
  return kept;
}

// two ways to the same force: servo step by step, and the history of its depths at one place
TEST_F(RunCommand, RelaxesAsTheHistoryOfItsDepths)
{
  const std::string relaxation = "--relaxation 0.3:50ms,0.2:1s";
  const Finished run = press("--no-picture " + relaxation + kTissue, "out");
  ASSERT_EQ(run.code, 0) << run.err;
  const std::filesystem::path file = folder_.path() / "out/samples.csv";
  const CsvTable samples = readCsv(file);
  const Finished force =
    palp("force --thickness 50mm " + relaxation + kTissue + " --history " + file.string());
  ASSERT_EQ(force.code, 0) << force.err;
  std::istringstream table(force.out);
  const std::vector<double> known = parseCsv(table)["force_N"];
  ASSERT_EQ(known.size(), samples["force_N"].size());
  const double most = *std::ranges::max_element(known);
  EXPECT_GT(most, 0.5);
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    EXPECT_NEAR(samples["force_N"][i], known[i], 3e-3 * most) << i;
  }
  EXPECT_GT(samples["surface_depth_mm"].back(), 0.5) << "a dent is left";
  EXPECT_EQ(samples["force_N"].back(), 0.0);
}

TEST_F(RunCommand, FrictionIsInTheForceAndInTheSamples)
{
  std::ostringstream rows;
  rows << "0,0,0," << topMm() + 1 << "\n0.1,0,0," << topMm() - 4 << "\n0.5,20,0," << topMm() - 4
       << "\n";
  const Finished run =
    pressAlong(rows.str(), std::string("--no-picture --friction 0.4") + kTissue, "out");
  ASSERT_EQ(run.code, 0) << run.err;
  const CsvTable samples = readCsv(folder_.path() / "out/samples.csv");
  const double coulomb = 0.4 * samples["force_N"].back();
  EXPECT_GT(coulomb, 0.1);
  EXPECT_NEAR(samples["friction_x_N"].back(), -coulomb, 1e-3 * coulomb);
  EXPECT_NEAR(samples["force_x_N"].back(), -coulomb, 1e-3 * coulomb);
  EXPECT_NEAR(samples["force_z_N"].back(), samples["force_N"].back(), 1e-7);
}

// which is not that of the deepest place, where the tissue has relaxed meanwhile
TEST_F(RunCommand, TellsTheLargestForce)
{
  std::ostringstream rows;
  rows << "0,0,0," << topMm() + 1 << "\n0.05,0,0," << topMm() - 3 << "\n0.5,0,0," << topMm() - 3.2
       << "\n";
  const Finished run =
    pressAlong(rows.str(), std::string("--no-picture --relaxation 0.8:20ms") + kTissue, "out");
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string words = "palp: largest force ";
  const std::size_t place = run.err.find(words);
  ASSERT_NE(place, std::string::npos) << run.err;
  const double most =
    *std::ranges::max_element(readCsv(folder_.path() / "out/samples.csv")["force_N"]);
  EXPECT_NEAR(std::stod(run.err.substr(place + words.size())), most, 1e-4 * most);
  EXPECT_EQ(
    press(std::string("--no-picture") + kTissue, "plain").err.find(words), std::string::npos);
}

TEST_F(RunCommand, WithoutThemNothingChanges)
{
  ASSERT_EQ(press(std::string("--no-picture") + kTissue, "plain").code, 0);
  ASSERT_EQ(press(std::string("--no-picture --friction 0") + kTissue, "none").code, 0);
  const std::string plain = bytesOf(folder_.path() / "plain/samples.csv");
  EXPECT_EQ(plain, bytesOf(folder_.path() / "none/samples.csv"));
  EXPECT_EQ(plain.find("friction"), std::string::npos);
}

TEST_F(RunCommand, RefusesThemOfTheOtherLawsAndOutOfRange)
{
  const auto refused = [&](const std::string& options, const std::string& what)
  {
    const Finished finished = press("--no-picture " + options, "out");
    EXPECT_EQ(finished.code, 2) << options;
    EXPECT_NE(finished.err.find(what), std::string::npos) << finished.err;
    EXPECT_EQ(test::sentences(finished).size(), 1U) << finished.err;
  };
  refused("--friction 0.3", "--friction: the law 'paper' knows none");
  refused("--law exact --relaxation 0.5:1s", "--relaxation: the law 'exact' knows none");
  refused("--law exact --relaxation 0.5:1s --friction 0.3 --stiffness formula:6",
    "--relaxation, --friction, --stiffness: the law 'exact' knows none of these; take the law "
    "'corrected', or leave them out");
  refused("--law corrected --friction -1", "--friction: '-1' is out of range; give 0 to 5");
  refused("--law corrected --friction nan", "--friction");
  refused("--law corrected --relaxation 0.5:1s,0.6:2s", "--relaxation: the fractions add up");
}

} // namespace
} // namespace palp
