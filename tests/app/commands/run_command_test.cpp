#include "app/press/body.h"
#include "haptics/devices/simulated/scripted_device.h"
#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/servo/servo_step.h"
#include "tests/app/commands/run_rig.h"

#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <regex>
#include <sstream>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

namespace palp
{
namespace
{

using namespace test;

TEST_F(RunCommand, MeasuresHertzOnTheBlock)
{
  const Finished finished = press("--no-picture --all-samples", "out");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const test::CsvTable samples = test::readCsv(folder_.path() / "out/samples.csv");

  // 0 to 150 ms, and the end that the grid misses
  ASSERT_EQ(samples["time_s"].size(), 152u);
  EXPECT_EQ(samples["time_s"][1], 0.001);
  EXPECT_EQ(samples["time_s"].back(), 0.1505);

  const std::size_t deepest = 100;
  EXPECT_NEAR(samples["depth_mm"][deepest], 5.0, 1e-4); // block coordinates are floats
  const double hertz = 4.0 / 3.0 * 50e3 / (1 - 0.33 * 0.33) * 0.1 * std::pow(0.005, 1.5);
  EXPECT_NEAR(samples["force_N"][deepest], hertz, 1e-4 * hertz);
  EXPECT_NEAR(samples["force_z_N"][deepest], hertz, 1e-4 * hertz);
  EXPECT_NEAR(samples["force_x_N"][deepest], 0.0, 1e-6);
  EXPECT_NEAR(samples["contact_radius_mm"][deepest], std::sqrt(50.0), 1e-3);
  EXPECT_GT(samples["extent_radius_mm"][deepest], samples["contact_radius_mm"][deepest]);
  EXPECT_EQ(samples["force_N"].front(), 0.0);
  EXPECT_EQ(samples["depth_mm"].back(), 0.0);
}

TEST_F(RunCommand, PressesThroughACoating)
{
  const std::string law =
    " --law corrected --material linear --young 50kPa --poisson 0.33 --coating 2mm:200kPa:0.4";
  const Finished finished = press("--no-picture --all-samples" + law, "out");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const auto file = folder_.path() / "out/samples.csv";
  EXPECT_NE(test::readAll(file).find("coated by 2mm:200kPa:0.4\n"), std::string::npos);
  const Finished alone =
    test::runCommand(PALP_PROGRAM " force --thickness 50mm --depth 5:5:1mm" + law);
  std::istringstream rows(alone.out);
  const double expected = test::parseCsv(rows)["force_N"].front();
  EXPECT_NEAR(test::readCsv(file)["force_N"][100], expected, 1e-3 * expected);
}

// Hertz and Sneddon by hand, from the numbers in the file alone
TEST_F(RunCommand, EachForceFollowsFromItsRow)
{
  struct Tool
  {
    const char* tip;
    double (*force)(double modulus, double depth);
  };
  const Tool tools[] = {
    { "sphere:10mm",
      [](double modulus, double d) { return 4.0 / 3.0 * modulus * 0.1 * std::pow(d, 1.5); } },
    { "cone:45deg:10mm", [](double modulus, double d) { return 2.0 / M_PI * modulus * d * d; } },
  };
  for (const auto& [tip, force] : tools)
  {
    for (const std::string law : { "paper", "exact", "corrected" })
    {
      const std::string out = (folder_.path() / (law + tip)).string();
      const Finished finished =
        palp("run --no-picture --out " + out + " --law " + law + " --tip " + tip);
      ASSERT_EQ(finished.code, 0) << finished.err;
      const std::string file = out + "/samples.csv";
      const std::string text = test::readAll(file);
      std::smatch found;
      ASSERT_TRUE(std::regex_search(
        text, found, std::regex("Young's modulus: (\\S+) kPa, Poisson's ratio: (\\S+)\n")));
      const double nu = std::stod(found[2]);
      const double modulus = 1e3 * std::stod(found[1]) / (1.0 - nu * nu);
      const test::CsvTable rows = test::readCsv(file);
      int acting = 0;
      for (std::size_t k = 0; k < rows["force_N"].size(); ++k)
      {
        double expected = force(modulus, rows["depth_mm"][k] / 1e3);
        for (const std::string name : { "shape", "curvature", "ellipse", "thickness",
               "large_strain", "inclination", "coatings" })
        {
          expected *= rows["factor_" + name][k];
          acting += std::abs(rows["factor_" + name][k] - 1.0) > 1e-9 ? 1 : 0;
        }
        ASSERT_NEAR(rows["force_N"][k], expected, 1e-9 * expected) << file << ' ' << k;
      }
      EXPECT_EQ(acting > 0, law == "corrected" || (law == "exact" && tip[0] == 's')) << law << tip;
    }
  }
}

// the place as the file tells it, asked again of palp force
TEST_F(RunCommand, EachFactorFollowsFromItsPlace)
{
  const std::string law = " --law corrected --tip sphere:10mm";
  const Finished finished =
    palp("run --no-picture --out " + (folder_.path() / "out").string() + law);
  ASSERT_EQ(finished.code, 0) << finished.err;
  const test::CsvTable rows = test::readCsv(folder_.path() / "out/samples.csv");
  int asked = 0;
  for (std::size_t k = 0; k < rows["force_N"].size(); k += 400)
  {
    if (rows["depth_mm"][k] < 0.5)
    {
      continue;
    }
    std::ostringstream position;
    position.precision(17);
    position << " --thickness " << rows["thickness_mm"][k] << "mm --surface-radius "
             << 1e3 / rows["curvature_per_m"][k] << "mm --tilt " << rows["tilt_deg"][k]
             << "deg --depth " << rows["depth_mm"][k] << ":" << rows["depth_mm"][k] << ":1mm";
    const Finished alone = palp("force" + law + position.str());
    std::istringstream table(alone.out);
    const double expected = test::parseCsv(table)["force_N"].front() * rows["factor_ellipse"][k];
    EXPECT_NEAR(rows["force_N"][k], expected, 1e-9 * expected) << position.str() << alone.err;
    ++asked;
  }
  EXPECT_GE(asked, 3);
}

// the vector on the tool by its columns, and the slope by how the depth changes on the way
TEST_F(RunCommand, TheForceOnTheToolFollowsFromItsRow)
{
  const Finished finished =
    palp("run --no-picture --law corrected --tip sphere:10mm --depth 6mm --toward 0,-1,0"
         " --at 0,200,0 --at -20,200,-30 --at -20,200,30 --out " +
      (folder_.path() / "out").string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  const test::CsvTable rows = test::readCsv(folder_.path() / "out/samples.csv");
  const auto at = [&rows](const char* start, const char* end, std::size_t k)
  {
    const auto column = [&](const char* axis) { return rows[std::string(start) + axis + end][k]; };
    return Eigen::Vector3d(column("x"), column("y"), column("z"));
  };
  double most = 0.0;
  for (std::size_t k = 1; k < rows["force_N"].size(); ++k)
  {
    const Eigen::Vector3d normal = at("normal_", "", k);
    const Eigen::Vector3d lateral = at("lateral_", "_N", k);
    const double slope = rows["depth_slope"][k];
    ASSERT_LT((at("force_", "_N", k) - rows["force_N"][k] * slope * normal - lateral).norm(), 1e-8);
    most = std::max(most, lateral.norm() / std::max(0.1, rows["force_N"][k]));
    const auto center = [&](std::size_t i)
    { return Eigen::Vector3d(at("tool_", "_mm", i) - 10.0 * at("axis_", "", i)); };
    const Eigen::Vector3d moved = center(k) - center(k - 1);
    if (rows["depth_mm"][k - 1] > 0.5 && moved.norm() < 0.1)
    {
      const Eigen::Vector3d before = rows["depth_slope"][k - 1] * at("normal_", "", k - 1);
      const double expected = -0.5 * (slope * normal + before).dot(moved);
      EXPECT_NEAR(rows["depth_mm"][k] - rows["depth_mm"][k - 1], expected, 0.01 * moved.norm())
        << k;
    }
  }
  EXPECT_GT(most, 0.03); // or this shows nothing of the shape
}

TEST_F(RunCommand, AReplayOfTheExportGivesTheSameForces)
{
  ASSERT_EQ(press("--no-picture --all-samples", "out").code, 0);
  const std::filesystem::path file = folder_.path() / "out/samples.csv";
  const test::CsvTable samples = test::readCsv(file);
  Scene scene;
  scene.surface = loadBody({ { .file = block() } }).haptic;
  scene.forceLimit = std::numeric_limits<double>::infinity();

  ScriptedDevice device(readPath(file)); // in ticks of a millisecond, as a servo asks it
  for (std::size_t k = 1; k < 151; ++k)
  {
    const Sample again = step(scene, *device.exchange(Eigen::Vector3d::Zero(), 0.001));
    EXPECT_NEAR(again.force.z(), samples["force_z_N"][k], 1e-9) << k;
    EXPECT_NEAR(again.response.force, samples["force_N"][k], 1e-9) << k;
  }
}

// above the block for as long as a force takes to start, then 5 mm into it in 0.2 s, and out again
TEST_F(RunCommand, ThroughTheChainTheForceIsWhatTheArmOfThePaperBears)
{
  std::ostringstream rows;
  rows << "0,0,0," << topMm() + 5 << "\n0.1,0,0," << topMm() + 5 << "\n0.3,0,0," << topMm() - 5
       << "\n0.4,0,0," << topMm() - 5 << "\n0.6,0,0," << topMm() + 5 << "\n";
  const auto path = writePath(folder_.path(), rows.str().c_str());
  for (const char* young : { "20kPa", "1.5MPa" })
  {
    const Finished finished = palp("run " + block() + " --path " + path.string() +
      " --chain --no-picture --all-samples --overwrite --young " + young + " --out " +
      (folder_.path() / "out").string());
    ASSERT_EQ(finished.code, 0) << finished.err;
    const test::CsvTable samples = test::readCsv(folder_.path() / "out/samples.csv");
    const auto& law = samples["force_N"];
    const auto& sent = samples["force_z_N"];
    for (std::size_t k = 1; k < sent.size(); ++k)
    {
      ASSERT_LE(sent[k], 4.0 * (1.0 + 1e-9)) << k;
      ASSERT_LE(std::abs(sent[k] - sent[k - 1]), 0.5 * (1.0 + 1e-9)) << k;
      ASSERT_GE(sent[k], 0.0) << k;
    }
    const std::size_t rest = 390; // 5 mm deep
    const auto flags = static_cast<unsigned>(samples["flags"][rest]);
    const bool soft = young[0] == '2';
    EXPECT_NEAR(sent[rest], soft ? law[rest] : 4.0, 1e-6);
    EXPECT_EQ((flags & static_cast<unsigned>(Flag::StiffnessLimited)) != 0, !soft);
  }
}

TEST_F(RunCommand, TellsWhereTheLawIsOutsideItsLimits)
{
  const auto namesDepth = [](const Finished& finished)
  {
    return std::regex_search(finished.err, std::regex("outside its limits .*\\bdepth\\b.*samples"));
  };
  // 5 mm is half of the tool's radius, 9 mm beyond the 0.55 of Sec. 4.3
  EXPECT_FALSE(namesDepth(press("--no-picture", "shallow")));
  std::ostringstream rows;
  rows << "0,0,0," << topMm() + 1.0 << "\n1,0,0," << topMm() - 9.0 << '\n';
  const Finished deep = palp("run " + block() + " --no-picture --path " +
    writePath(folder_.path(), rows.str().c_str()).string() + " --out " +
    (folder_.path() / "deep").string());
  EXPECT_TRUE(namesDepth(deep)) << deep.err;
}

TEST_F(RunCommand, WritesTheDeepestMomentInMillimeters)
{
  ASSERT_EQ(press("--no-picture", "out").code, 0);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder_.path() / "out/deformed.vtp").c_str());
  reader->Update();
  vtkPolyData* mesh = reader->GetOutput();
  double bounds[6];
  mesh->GetBounds(bounds);
  EXPECT_NEAR(bounds[1] - bounds[0], 100.0, 0.01);
  vtkDataArray* displacement = mesh->GetPointData()->GetArray("Displacement");
  ASSERT_NE(displacement, nullptr);
  ASSERT_NE(mesh->GetPointData()->GetArray("Zone"), nullptr);
  double lowest = 0.0;
  for (vtkIdType i = 0; i < displacement->GetNumberOfTuples(); ++i)
  {
    lowest = std::min(lowest, displacement->GetComponent(i, 2));
  }
  EXPECT_NEAR(lowest, -5.0, 0.3); // a mesh point need not lie right below the apex
}

// Fig. 5(b): from P0 on the sphere at r = sqrt(R depth) along its tangent to P1 at rest, then to P2
// at R_d; all in mm
double ringOfThePaper(double depth, double extent, double radius)
{
  const double r = std::sqrt(10.0 * depth);
  const double height = std::sqrt(100.0 - r * r); // of the sphere's middle over P0
  const double sink = depth - (10.0 - height);
  const double meet = r + sink * height / r;
  const double bend = r - 2.0 * meet + extent;
  const double first = meet - r;
  const double u = (std::sqrt(first * first + bend * (radius - r)) - first) / bend;
  return sink * (1.0 - u) * (1.0 - u);
}

// as is to half of the radius, where the usual picture is the same, and by its name beyond
TEST_F(RunCommand, DrawsThePapersRing)
{
  const double top = topMm();
  double furthest = 0.0; // [mm] of the usual picture from the paper's 7 mm deep
  for (const char* surface : { "paper", "paper-literal" })
  {
    for (const double depth : { 2.0, 5.0, 7.0, 8.0, 9.0 })
    {
      const std::string name = surface + std::to_string(depth);
      std::ostringstream rows;
      rows << "0,0,0," << top + 1.0 << "\n0.01,0,0," << top - depth << '\n';
      const auto path = writePath(folder_.path(), rows.str().c_str());
      const Finished finished = palp("run " + block() + " --no-picture --path " + path.string() +
        " --surface " + surface + " --out " + (folder_.path() / name).string());
      ASSERT_EQ(finished.code, 0) << finished.err;
      const double extent =
        test::readCsv(folder_.path() / name / "samples.csv")["extent_radius_mm"].back();
      vtkNew<vtkXMLPolyDataReader> reader;
      reader->SetFileName((folder_.path() / name / "deformed.vtp").c_str());
      reader->Update();
      vtkPolyData* mesh = reader->GetOutput();
      vtkDataArray* displacement = mesh->GetPointData()->GetArray("Displacement");
      int compared = 0;
      for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
      {
        const double* point = mesh->GetPoint(i);
        const double radius = std::hypot(point[0], point[1]);
        const double sunk = -displacement->GetComponent(i, 2);
        if (point[2] + sunk > top - 0.01 && radius > std::sqrt(10.0 * depth) && radius < extent)
        {
          const double off = std::abs(sunk - ringOfThePaper(depth, extent, radius));
          const bool isTheirs = depth < 5.5 || name.starts_with("paper-literal");
          EXPECT_LE(off, isTheirs ? 0.001 : 2.0) << name << " at " << radius;
          furthest = std::max(furthest, isTheirs ? 0.0 : off);
          ++compared;
        }
      }
      EXPECT_GE(compared, 12) << name;
    }
  }
  EXPECT_GT(furthest, 0.05); // or the name means nothing
}

// damping adds to the law's force: nothing is cut then
TEST_F(RunCommand, TellsTheForceThatTheDeviceGets)
{
  const Finished finished = press("--no-picture --damping 20N*s/m", "out");
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(finished.err.find(" N to the device: with damping"), std::string::npos) << finished.err;
  EXPECT_EQ(finished.err.find("cut"), std::string::npos) << finished.err;
}

} // namespace
} // namespace palp
