#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

namespace palp
{
namespace
{

using nlohmann::json;

// a ball of 4 mm by Hertz: E 8 kPa, nu 0.45, contact at 1.2 mm of the stage, 50 mN of the sensor
std::string hertzian(double noise, unsigned seed, bool unloads = false)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, 1.0);
  std::ostringstream text;
  text.precision(17);
  text << "depth_mm,force_N\n";
  const auto add = [&](double depth, double factor)
  {
    const double deep = 1e-3 * std::max(0.0, depth - 1.2);
    const double force = 4.0 / 3.0 * 8e3 / (1.0 - 0.45 * 0.45) * std::sqrt(4e-3 * deep) * deep;
    text << depth << ',' << 0.05 + factor * force + (noise > 0.0 ? noise * error(random) : 0.0)
         << '\n';
  };
  for (int i = 0; i <= 40; ++i)
  {
    add(0.1 * i, 1.0);
  }
  for (int i = 40; unloads && i >= 0; --i)
  {
    add(0.1 * i, 0.6); // tissue that has relaxed
  }
  return text.str();
}

class FitCommand : public testing::Test
{
protected:
  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_.path() / name) << text;
    return name;
  }

  [[nodiscard]] test::Finished fit(const std::string& arguments) const
  {
    return test::runCommand(
      "cd " + folder_.path().string() + " && " PALP_PROGRAM " fit --out out " + arguments);
  }

  [[nodiscard]] json fitted() const
  {
    return json::parse(test::readAll(folder_.path() / "out" / "fit.json"));
  }

  test::TemporaryFolder folder_;
};

constexpr const char* kBall = " --tip sphere:4mm --poisson 0.45 --no-picture ";

TEST_F(FitCommand, FindsTheModulusOfHertzWithEverySetting)
{
  write("press.csv", hertzian(0.0, 0));
  const test::Finished run = fit("press.csv" + std::string(kBall));
  ASSERT_EQ(run.code, 0) << run.err;
  const json result = fitted();
  EXPECT_NEAR(result["young_Pa"].get<double>(), 8e3, 8e3 * 1e-6);
  EXPECT_LE(result["young_Pa_low"].get<double>(), 8e3);
  EXPECT_GE(result["young_Pa_high"].get<double>(), 8e3);
  EXPECT_NEAR(result["contact_mm"].get<double>(), 1.2, 1e-6);
  EXPECT_NEAR(result["offset_N"].get<double>(), 0.05, 1e-8);
  EXPECT_NEAR(result["exponent"].get<double>(), 1.5, 1e-5);
  EXPECT_EQ(result["best_law"], "paper");
  EXPECT_EQ(result["settings"]["tool"], "sphere:4mm");
  EXPECT_EQ(result["settings"]["poisson"], 0.45);
  EXPECT_EQ(result["settings"]["law"], "paper");
  EXPECT_EQ(result["settings"]["contact_mm"], "searched");
  EXPECT_EQ(result["settings"]["confidence"], 0.95);
  EXPECT_EQ(result["laws"].size(), 4u); // paper, exact, corrected, power
}

TEST_F(FitCommand, WarnsWhereUnitsMustBeOthers)
{
  const std::string head = "depth_mm,force_N\n";
  std::string meters = head;
  std::string millinewtons = head;
  std::string right = head;
  for (int i = 1; i <= 40; ++i)
  {
    const double depth = 0.1 * i; // [mm]
    const double force =
      4.0 / 3.0 * 8e3 / (1.0 - 0.45 * 0.45) * std::sqrt(4e-3 * 1e-9 * depth * depth * depth);
    meters += std::to_string(1e-3 * depth) + ',' + std::to_string(force) + '\n';
    millinewtons += std::to_string(depth) + ',' + std::to_string(1e3 * force) + '\n';
    right += std::to_string(depth) + ',' + std::to_string(force) + '\n';
  }
  const auto said = [&](const std::string& rows)
  {
    const test::Finished run =
      fit(write("rows.csv", rows) + kBall + "--contact 0mm --offset 0N --overwrite");
    EXPECT_EQ(run.code, 0) << run.err;
    return run.err;
  };
  EXPECT_NE(said(meters).find("is depth_mm in mm"), std::string::npos);
  EXPECT_NE(said(millinewtons).find("is depth_mm in mm"), std::string::npos);
  EXPECT_EQ(said(right).find("is depth_mm in mm"), std::string::npos);
}

TEST_F(FitCommand, WritesWhatWasMeasuredAndFittedRowByRow)
{
  write("press.csv", hertzian(1e-3, 1));
  ASSERT_EQ(fit("press.csv" + std::string(kBall)).code, 0);
  std::ifstream table(folder_.path() / "out" / "fit.csv");
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "curve,depth_mm,force_N,fitted_N,residual_N");
  int rows = 0;
  for (double depth = 0.0, force = 0.0, curve = 0.0, rest = 0.0; std::getline(table, line); ++rows)
  {
    ASSERT_EQ(std::sscanf(line.c_str(), "press,%lf,%lf,%lf,%lf", &depth, &force, &curve, &rest), 4);
    EXPECT_NEAR(rest, force - curve, 1e-12);
    EXPECT_LT(std::abs(rest), 5e-3); // five deviations of the noise
  }
  EXPECT_EQ(rows, 41);
}

TEST_F(FitCommand, DrawsCurveAndResiduals)
{
  write("press.csv", hertzian(1e-3, 1));
  const test::Finished run = fit("press.csv --tip sphere:4mm --poisson 0.45");
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* picture : { "fit.png", "residuals.png" })
  {
    EXPECT_EQ(test::readAll(folder_.path() / "out" / picture).substr(1, 3), "PNG") << picture;
  }
}

TEST_F(FitCommand, LeavesTheUnloadingOutAndSaysSo)
{
  write("press.csv", hertzian(0.0, 0, true));
  const test::Finished run = fit("press.csv" + std::string(kBall));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("rows 1 to 41 of 82 are the loading"), std::string::npos) << run.err;
  EXPECT_NEAR(fitted()["young_Pa"].get<double>(), 8e3, 8e3 * 1e-6);
}

TEST_F(FitCommand, TakesASeriesInOneCall)
{
  std::string files;
  constexpr unsigned kCurves = 100;
  for (unsigned i = 0; i < kCurves; ++i)
  {
    files += write("press" + std::to_string(i) + ".csv", hertzian(2e-3, i)) + " ";
  }
  ASSERT_EQ(fit(files + kBall).code, 0);
  const json curves = fitted()["curves"];
  ASSERT_EQ(curves.size(), kCurves);
  EXPECT_EQ(curves[7]["curve"], "press7.csv");
  const auto covered = std::ranges::count_if(curves,
    [](const json& curve)
    { return curve["young_Pa_low"] <= 8e3 && 8e3 <= curve["young_Pa_high"]; });
  EXPECT_NEAR(static_cast<double>(covered), 95.0, 8.7); // four deviations, of the binomial
}

TEST_F(FitCommand, TakesTheOutputOfForceAndOfRun)
{
  ASSERT_EQ(test::runCommand("cd " + folder_.path().string() +
              " && " PALP_PROGRAM
              " force --tip cone:30deg:10mm --young 5kPa --poisson 0.45 > law.csv && " PALP_PROGRAM
              " run " PALP_SHARE "/meshes/block_50.vtp --path " PALP_SOURCE_DIR
              "/data/paths/block_press.csv --tip cone:30deg:10mm --young 5kPa --poisson 0.45 "
              "--no-picture --out run")
              .code,
    0);
  for (const char* file : { "law.csv", "run/samples.csv" })
  {
    const test::Finished run =
      fit(std::string(file) + " --tip cone:30deg:10mm --poisson 0.45 --no-picture --overwrite");
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NEAR(fitted()["young_Pa"].get<double>(), 5e3, 5e3 * 1e-5) << file;
    EXPECT_NEAR(fitted()["contact_mm"].get<double>(), 0.0, 1e-4) << file;
    EXPECT_EQ(run.err.find("recorded with"), std::string::npos) << run.err;
  }
  const test::Finished other =
    fit("run/samples.csv --tip sphere:5mm --poisson 0.45 --no-picture --overwrite");
  EXPECT_NE(other.err.find("recorded with the tool cone:30deg:10mm"), std::string::npos)
    << other.err;
}

TEST_F(FitCommand, SearchesTheThicknessOnRequest)
{
  ASSERT_EQ(test::runCommand("cd " + folder_.path().string() +
              " && " PALP_PROGRAM " force --tip sphere:6mm --young 5kPa --law corrected "
              "--thickness 20mm --depth 0:5:0.2mm > layer.csv")
              .code,
    0);
  ASSERT_EQ(fit("layer.csv --tip sphere:6mm --no-picture --fit thickness").code, 0);
  EXPECT_NEAR(fitted()["thickness_mm"].get<double>(), 20.0, 0.02);
  EXPECT_NEAR(fitted()["young_Pa"].get<double>(), 5e3, 5.0);
  EXPECT_EQ(fitted()["best_law"], "corrected with thickness");
}

TEST_F(FitCommand, RefusesBadInputInOneSentence)
{
  write("press.csv", hertzian(0.0, 0));
  write("norows.csv", "depth_mm,force_N\n");
  write("nan.csv", "depth_mm,force_N\n0,0\n1,nan\n2,1\n3,2\n4,4\n");
  write("negative.csv", "depth_mm,force_N\n0,-1\n1,-2\n2,-3\n3,-5\n4,-8\n");
  write("huge.csv", "depth_mm,force_N\n0,0\n1,1e300\n2,3e300\n3,5e300\n4,8e300\n");
  write("tiny.csv", "depth_mm,force_N\n0,0\n1,1e-300\n2,3e-300\n3,5e-300\n4,8e-300\n");
  write("names.csv", "depth,force\n0,0\n1,1\n");
  write("constant.csv", "depth_mm,force_N\n1,0\n1,1\n1,2\n1,3\n1,4\n");
  write("few.csv", "depth_mm,force_N\n0,0\n1,1\n");
  write("back.csv", "depth_mm,force_N\n3,3\n2,2\n1,1\n0,0\n");
  const std::pair<const char*, const char*> refused[] = { { "norows.csv", "no row" },
    { "nan.csv", "nan.csv:3: not finite" }, { "negative.csv", "no force is above 0" },
    { "names.csv", "no column depth_mm" }, { "constant.csv", "one depth" },
    { "few.csv", "give more rows" }, { "back.csv", "only falls" }, { "absent.csv", "absent.csv" },
    { "huge.csv", "e+30" }, { "tiny.csv", "not 1 Pa to 10 GPa" },
    { "press.csv --poisson 0.6", "give 0 to 0.5" },
    { "press.csv --thickness 5mm --fit thickness", "excludes" },
    { "press.csv negative.csv", "negative.csv: " } };
  for (const auto& [arguments, sentence] : refused)
  {
    const test::Finished run = fit(std::string(arguments) + " --tip sphere:4mm --no-picture");
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_EQ(test::sentences(run).size(), 1U) << run.err;
    EXPECT_NE(run.err.find(sentence), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out")) << arguments;
  }
  const test::Finished toolless = fit("press.csv --no-picture");
  EXPECT_EQ(toolless.code, 2);
  EXPECT_NE(toolless.err.find("--tip"), std::string::npos) << toolless.err;
}

// one row of 5 N among forces of 0.3 N pulls the contact to where nothing was measured
TEST_F(FitCommand, TellsWhereTheContactIsNoWhereNearTheRows)
{
  std::string text = "depth_mm,force_N\n";
  for (int i = 0; i < 200; ++i)
  {
    const double depth = 0.02 * i;
    const double force =
      4.0 / 3.0 * 12e3 / (1.0 - 0.45 * 0.45) * std::sqrt(4e-6 * depth) * 1e-3 * depth;
    text += std::to_string(depth) + "," + std::to_string(i == 100 ? 5.0 : force) + "\n";
  }
  const std::string tool = " --tip sphere:4mm --poisson 0.45 --no-picture --overwrite";
  const test::Finished spiked = fit(write("spike.csv", text) + tool);
  EXPECT_EQ(spiked.code, 0) << spiked.err;
  EXPECT_NE(spiked.err.find("is far before the first row, so E means nothing"), std::string::npos)
    << spiked.err;
  EXPECT_EQ(
    fit(write("plain.csv", hertzian(1e-3, 1)) + tool).err.find("means nothing"), std::string::npos);
}

} // namespace
} // namespace palp
