#include "app/press/body.h"
#include "haptics/devices/simulated/scripted_device.h"
#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/servo/servo_step.h"
#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

namespace palp
{
namespace
{

using test::Finished;

Finished palp(const std::string& arguments)
{
  return test::runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " PALP_PROGRAM " " + arguments);
}

// down onto the middle of the block's upper face, 5 mm deep, and up again
std::filesystem::path writePath(const std::filesystem::path& folder, const char* rows)
{
  const std::filesystem::path file = folder / "press.csv";
  std::ofstream(file) << "time_s,x_mm,y_mm,z_mm\n" << rows;
  return file;
}

class RunCommand : public ::testing::Test
{
protected:
  // the upper face of the shipped block, whose frame the path is in
  [[nodiscard]] double topMm() const
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(block().c_str());
    reader->Update();
    return reader->GetOutput()->GetBounds()[5];
  }
  [[nodiscard]] std::string block() const
  {
    return PALP_SHARE "/meshes/block_50.vtp";
  }

  [[nodiscard]] Finished press(const std::string& extra, const std::string& out)
  {
    std::ostringstream rows;
    rows << "0,0,0," << topMm() + 2 << "\n0.1,0,0," << topMm() - 5 << "\n0.1505,0,0," << topMm() + 1
         << "\n";
    const auto path = writePath(folder_.path(), rows.str().c_str());
    return palp("run " + block() + " --path " + path.string() + " --out " +
      (folder_.path() / out).string() + " " + extra);
  }

  test::TemporaryFolder folder_;
};

std::size_t colorsOf(const std::filesystem::path& png, int width, int height)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  EXPECT_EQ(image->GetDimensions()[0], width) << png;
  EXPECT_EQ(image->GetDimensions()[1], height) << png;
  std::set<std::array<int, 3>> colors;
  vtkDataArray* pixels = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; pixels && i < pixels->GetNumberOfTuples(); ++i)
  {
    const double* rgb = pixels->GetTuple(i);
    colors.insert({ int(rgb[0]), int(rgb[1]), int(rgb[2]) });
  }
  return colors.size();
}

TEST_F(RunCommand, MeasuresHertzOnTheBlock)
{
  const Finished finished = press("--no-picture", "out");
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
  const Finished finished = press("--no-picture" + law, "out");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const auto file = folder_.path() / "out/samples.csv";
  EXPECT_NE(test::readAll(file).find("coated by 2mm:200kPa:0.4\n"), std::string::npos);
  const Finished alone =
    test::runCommand(PALP_PROGRAM " force --thickness 50mm --depth 5:5:1mm" + law);
  std::istringstream rows(alone.out);
  const double expected = test::parseCsv(rows)["force_N"].front();
  EXPECT_NEAR(test::readCsv(file)["force_N"][100], expected, 1e-3 * expected);
}

TEST_F(RunCommand, GivesTheSameBytesTwice)
{
  ASSERT_EQ(press("--no-picture", "a").code, 0);
  ASSERT_EQ(press("--no-picture", "b").code, 0);
  const std::string first = test::readAll(folder_.path() / "a/samples.csv");
  EXPECT_GT(first.size(), 1000u);
  EXPECT_EQ(first, test::readAll(folder_.path() / "b/samples.csv"));
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
    std::ostringstream place;
    place.precision(17);
    place << " --thickness " << rows["thickness_mm"][k] << "mm --surface-radius "
          << 1e3 / rows["curvature_per_m"][k] << "mm --tilt " << rows["tilt_deg"][k]
          << "deg --depth " << rows["depth_mm"][k] << ":" << rows["depth_mm"][k] << ":1mm";
    const Finished alone = palp("force" + law + place.str());
    std::istringstream table(alone.out);
    const double expected = test::parseCsv(table)["force_N"].front() * rows["factor_ellipse"][k];
    EXPECT_NEAR(rows["force_N"][k], expected, 1e-9 * expected) << place.str() << alone.err;
    ++asked;
  }
  EXPECT_GE(asked, 3);
}

TEST_F(RunCommand, TellsWhichMeshAndHow)
{
  ASSERT_EQ(press("--no-picture --young 20kPa", "out").code, 0);
  const std::string text = test::readAll(folder_.path() / "out/samples.csv");
  const Finished sum = test::runCommand("sha256sum " + block()); // of other hands
  EXPECT_NE(text.find("# felt: block_50.vtp, SHA-256 " + sum.out.substr(0, 64) +
              ", read in mm, frame of the file\n"),
    std::string::npos)
    << text.substr(0, 2000);
  EXPECT_NE(text.find("# command: palp run " + block() + " --path " + folder_.path().string() +
              "/press.csv --no-picture --young 20kPa\n"),
    std::string::npos)
    << text.substr(0, 2000);
}

TEST_F(RunCommand, ReplacesWhatIsThereOnlyWhenAsked)
{
  ASSERT_EQ(press("--no-picture", "out").code, 0);
  const auto file = folder_.path() / "out/samples.csv";
  const std::string before = test::readAll(file);
  const Finished refused = press("--no-picture --young 5kPa", "out");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("of an earlier run; pass --overwrite"), std::string::npos);
  EXPECT_EQ(refused.err.find("deepest"), std::string::npos) << "after the press";
  EXPECT_EQ(test::readAll(file), before);
  std::ofstream(folder_.path() / "out/section.svg") << "of the run before";
  const Finished replaced = press("--no-picture --young 5kPa --overwrite", "out");
  EXPECT_EQ(replaced.code, 0);
  EXPECT_NE(
    replaced.err.find("will replace deformed.vtp, samples.csv, section.svg"), std::string::npos)
    << replaced.err;
  EXPECT_NE(test::readAll(file), before);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/section.svg"));
}

// a limit on the size of files stands for a full disk
TEST_F(RunCommand, AFullDiskLeavesTheEarlierFilesAndOneSentence)
{
  ASSERT_EQ(press("", "out").code, 0);
  const auto out = folder_.path() / "out";
  const std::string samples = test::readAll(out / "samples.csv");
  const std::string picture = test::readAll(out / "press.png");
  for (const char* blocks : { "8", "64" }) // of 512 bytes: samples.csv, then press.png
  {
    const Finished full = test::runCommand("ulimit -f " + std::string(blocks) +
      "; " PALP_PROGRAM " run --overwrite --out " + out.string() + " " +
      (blocks[0] == '6' ? block() : "") +
      (blocks[0] == '6' ? " --path " + writePath(folder_.path(), "0,0,0,20\n0.05,0,0,20\n").string()
                        : ""));
    EXPECT_EQ(full.code, 2);
    EXPECT_NE(full.err.find("cannot be written (File too large)"), std::string::npos) << full.err;
    EXPECT_EQ(full.err.find("\x1b"), std::string::npos) << full.err;
    EXPECT_EQ(full.err.find("libpng"), std::string::npos) << full.err;
    EXPECT_EQ(test::readAll(out / "samples.csv"), samples);
    EXPECT_EQ(test::readAll(out / "press.png"), picture);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out), {}), 5);
  }
}

TEST_F(RunCommand, ASignalLeavesNothingBehind)
{
  const auto out = folder_.path() / "out";
  for (const char* signal : { "INT", "TERM", "HUP" })
  {
    const Finished ended = test::runCommand(PALP_PROGRAM " run --out " + out.string() +
      " 2>/dev/null & running=$!; until [ -e " + out.string() +
      "/.palp-* ]; do sleep 0.01; done; kill -" + signal + " $running; wait $running");
    EXPECT_GT(ended.code, 128) << signal; // as a shell tells it
    EXPECT_FALSE(std::filesystem::exists(out)) << signal;
  }
}

TEST_F(RunCommand, TwoAtOnceDoNotMix)
{
  const std::string out = (folder_.path() / "out").string();
  const std::string run = PALP_PROGRAM " run --out " + out;
  const Finished both = test::runCommand(run + " >/dev/null 2>&1 & running=$!; until [ -e " + out +
    "/.palp-* ]; do sleep 0.01; done; " + run + "; echo $?; wait $running; echo $?");
  EXPECT_EQ(both.out, "2\n0\n") << both.err;
  EXPECT_NE(both.err.find("another palp is writing there"), std::string::npos) << both.err;
}

TEST_F(RunCommand, AReplayOfTheExportGivesTheSameForces)
{
  ASSERT_EQ(press("--no-picture", "out").code, 0);
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
      " --chain --no-picture --overwrite --young " + young + " --out " +
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

TEST_F(RunCommand, WritesTheDeepestMomentInMillimetres)
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

TEST_F(RunCommand, DrawsPicturesWithoutADisplay)
{
  const Finished finished = press("--size 800x600", "out");
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_GT(colorsOf(folder_.path() / "out/press.png", 800, 600), 500u);
  for (const char* chart : { "out/force_time.png", "out/force_depth.png" })
  {
    EXPECT_TRUE(std::filesystem::file_size(folder_.path() / chart) > 5000) << chart;
  }
}

TEST_F(RunCommand, SaysSoWhereNothingCanBeDrawn)
{
  const std::string none =
    "env __EGL_VENDOR_LIBRARY_DIRS=/nonexistent LIBGL_DRIVERS_PATH=/nonexistent ";
  const auto path = writePath(folder_.path(), "0,0,0,100\n0.01,0,0,99\n");
  const Finished finished = test::runCommand(none + PALP_PROGRAM " run " + block() + " --path " +
    path.string() + " --out " + (folder_.path() / "out").string());
  EXPECT_EQ(finished.code, 4) << finished.err;
  EXPECT_NE(finished.err.find("--no-picture"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/press.png"));
}

TEST_F(RunCommand, RefusesWhatItCannotRead)
{
  const std::string out = " --no-picture --out " + (folder_.path() / "out").string();
  for (const std::string& arguments : { "run /nonexistent.stl --path x.csv" + out,
         "run " + block() + " --path /nonexistent.csv" + out, "run " + block() + out,
         "run " + block() + " --size 10 --path x.csv" + out })
  {
    const Finished finished = palp(arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

TEST_F(RunCommand, RefusesWhatWouldBeInVainBeforeTheWork)
{
  const auto refused = [&](const std::string& arguments, const char* word)
  {
    const Finished finished = palp("run " + block() + " --no-picture " + arguments);
    EXPECT_EQ(finished.code, 2) << finished.err;
    EXPECT_NE(finished.err.find(word), std::string::npos) << finished.err;
    EXPECT_EQ(finished.err.find("deepest"), std::string::npos) << "after the press";
  };
  const std::string out = " --out " + (folder_.path() / "out").string();
  const std::string press = " --path " + writePath(folder_.path(), "0,0,0,20\n1,0,0,20\n").string();
  refused(press + " --out /proc/palp", "/proc/palp");
  refused(" --path " + folder_.path().string() + out, "a folder");
  const auto endless = writePath(folder_.path(), "0,0,0,20\n1e9,0,0,20\n");
  refused(" --path " + endless.string() + out, "longer than an hour");
  const auto eternal = writePath(folder_.path(), "0,0,0,20\n1e300,0,0,20\n");
  refused(" --path " + eternal.string() + out, "longer than an hour");
  refused(press + out + " --reference /nonexistent.csv", "/nonexistent.csv");
  refused(press + out + " --reference " + press.substr(8), "no column depth_mm");
}

// an option without effect is a mistake that nobody would see
TEST_F(RunCommand, RefusesWhatWouldHaveNoEffect)
{
  const auto reference = folder_.path() / "law.csv";
  std::ofstream(reference) << "depth_mm,force_N\n0,0\n1,1\n";
  for (const std::string& bad :
    { std::string("--no-picture --plots section"), "--no-picture --reference " + reference.string(),
      "--plots section --reference " + reference.string(),
      std::string("--plots force-time --plot-files svg"), std::string("--law paper --law exact"),
      std::string("--layer 1e300mm"), std::string("--layer 0.001mm"),
      std::string("--threshold 1000m") })
  {
    const Finished finished = press(bad, "none");
    EXPECT_EQ(finished.code, 2) << bad;
    EXPECT_EQ(finished.err.rfind("palp: --", 0), 0U) << bad << '\n' << finished.err;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_EQ(finished.err.find("Most 1 required"), std::string::npos) << finished.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "none")) << bad;
  }
}

// damping adds to the law's force: nothing is cut then
TEST_F(RunCommand, TellsTheForceThatTheDeviceGets)
{
  const Finished finished = press("--no-picture --damping 20N*s/m", "out");
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(finished.err.find(" N to the device)"), std::string::npos) << finished.err;
  EXPECT_EQ(finished.err.find("cut"), std::string::npos) << finished.err;
}

TEST(Program, TellsOfARemovedFolderInOneSentence)
{
  const test::TemporaryFolder folder;
  const std::string gone = (folder.path() / "gone").string();
  const Finished finished = test::runCommand("mkdir " + gone + " && cd " + gone + " && rmdir " +
    gone + " && " PALP_PROGRAM " run --no-picture --out k");
  EXPECT_EQ(finished.code, 2) << finished.err;
  EXPECT_EQ(finished.err.find("internal error"), std::string::npos) << finished.err;
}

TEST(Program, ShowsNoControlCharacterOfAnOption)
{
  const Finished finished = palp("force --law \"$(printf '\\033[31m')\"");
  EXPECT_EQ(finished.code, 2);
  EXPECT_EQ(finished.err.find('\033'), std::string::npos) << finished.err;
  EXPECT_EQ(finished.err.rfind("palp: --law", 0), 0U) << finished.err;
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

TEST_F(RunCommand, CalibratesWithTablesAndPlots)
{
  const std::string out = (folder_.path() / "calibration").string();
  const Finished finished =
    palp("calibrate --block 100x100x50mm --tip sphere:10mm --material linear "
         "--depth 1:2:0.5mm --element-size 0.5mm --out " +
      out);
  ASSERT_EQ(finished.code, 0) << finished.err;
  const test::CsvTable table = test::readCsv(folder_.path() / "calibration/table.csv");
  EXPECT_EQ(table["depth_mm"], (std::vector<double>{ 1.0, 1.5, 2.0 }));
  for (const char* chart : { "extent.png", "force.png", "profiles.png" })
  {
    EXPECT_GT(colorsOf(folder_.path() / "calibration" / chart, 1000, 600), 10u) << chart;
  }
}

// what palp writes it reads again: a law's table and a recording as references, and a recording as
// a path, which gives the same forces
TEST_F(RunCommand, TakesItsOwnTablesAndRecordings)
{
  ASSERT_EQ(press("--no-picture", "first").code, 0);
  const auto samples = folder_.path() / "first/samples.csv";
  const auto law = folder_.path() / "law.csv";
  ASSERT_EQ(palp("force --depth 0:6:1mm > " + law.string()).code, 0);
  const auto again = folder_.path() / "again";
  const Finished finished = palp("run " + block() + " --path " + samples.string() +
    " --plots comparison --plot-files csv --reference " + law.string() + " --reference " +
    samples.string() + " --out " + again.string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(test::readAll(again / "comparison.csv").find("\"law\",6,"), std::string::npos);
  EXPECT_NE(test::readAll(again / "comparison.csv").find("\"samples\",5,"), std::string::npos);
  const test::CsvTable before = test::readCsv(samples);
  const test::CsvTable after = test::readCsv(again / "samples.csv");
  ASSERT_EQ(after["force_N"].size(), before["force_N"].size());
  for (std::size_t i = 0; i < before["force_N"].size(); ++i)
  {
    EXPECT_NEAR(after["force_N"][i], before["force_N"][i], 1e-9) << i;
  }
}

TEST_F(RunCommand, AnUnsetVariableIsNoDefault)
{
  const std::string out = " --no-picture --out " + (folder_.path() / "out").string();
  for (const std::string& arguments :
    { "run ''" + out, "run --path ''" + out, std::string("run --out ''"), std::string("''") })
  {
    const Finished finished = palp(arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_NE(finished.err.find("is empty"), std::string::npos) << finished.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
}

TEST(Program, HelpsByWordAndNamesTheCommands)
{
  for (const char* arguments : { "help", "--help", "help run", "run --help" })
  {
    const Finished finished = palp(arguments);
    EXPECT_EQ(finished.code, 0) << arguments;
    EXPECT_NE(finished.out.find(std::string(arguments).find("run") < 9 ? "--path" : "calibrate"),
      std::string::npos)
      << arguments;
  }
  const Finished slip = palp("runn");
  EXPECT_EQ(slip.code, 2);
  EXPECT_NE(slip.err.find("'runn' is neither a command nor a file here"), std::string::npos);
  EXPECT_NE(slip.err.find("calibrate"), std::string::npos) << slip.err;
  // what is wrong with the file comes before the missing display
  EXPECT_NE(palp("view /nonexistent.stl").err.find("/nonexistent.stl"), std::string::npos);
}

TEST_F(RunCommand, ShowsNoControlCharacterOfAFile)
{
  const auto path = writePath(folder_.path(), "\033]0;owned\007,1,2,3\n");
  const Finished finished = palp(
    "run --no-picture --path " + path.string() + " --out " + (folder_.path() / "out").string());
  EXPECT_EQ(finished.code, 2);
  EXPECT_EQ(finished.err.find_first_of("\033\007"), std::string::npos) << finished.err;
}

TEST(Program, IsHardenedLikeAllBesideIt)
{
  for (const char* name : { "palp", "palp-read", "palp-draw", "palp-view", "palp-devices" })
  {
    const auto file = std::filesystem::path(PALP_PROGRAM).parent_path() / name;
    const Finished told = test::runCommand("readelf -hldW --dyn-syms " + file.string());
    ASSERT_EQ(told.code, 0) << told.err;
    EXPECT_TRUE(std::regex_search(told.out, std::regex("Type: +DYN"))) << name; // PIE
    EXPECT_NE(told.out.find("GNU_RELRO"), std::string::npos) << name;
    EXPECT_NE(told.out.find("BIND_NOW"), std::string::npos) << name;
    EXPECT_NE(told.out.find("__stack_chk_fail"), std::string::npos) << name;
  }
}

TEST(Program, MapsNoWindowGraphicsOrDeviceLibrary)
{
  const Finished finished = test::runCommand("ldd " PALP_PROGRAM);
  ASSERT_EQ(finished.code, 0);
  for (const char* library :
    { "Qt5", "libGL", "libEGL", "libX11", "hidapi", "libusb", "RenderingOpenGL" })
  {
    EXPECT_EQ(finished.out.find(library), std::string::npos) << library;
  }
}

// every plot in every kind of file, the user's own curve among them
TEST_F(RunCommand, WritesThePlotsThatAreAskedFor)
{
  const auto reference = folder_.path() / "mine.csv";
  std::ofstream(reference) << "depth_mm,force_N\n1,0.25\n4,2.0\n";
  const Finished finished = press(
    "--plots section,comparison,extent --plot-files png,svg,csv --reference " + reference.string(),
    "plots");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const auto out = folder_.path() / "plots";
  for (const std::string name : { "section", "comparison", "extent" })
  {
    for (const char* ending : { ".png", ".svg", ".csv" })
    {
      EXPECT_TRUE(std::filesystem::exists(out / (name + ending))) << name << ending;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(out / "force_time.png"));
  const std::string forces = test::readAll(out / "comparison.csv");
  EXPECT_NE(forces.find("\"mine\",4,2\n"), std::string::npos);
  EXPECT_NE(forces.find("\"finite elements\",1,0.252384048021\n"), std::string::npos); // the table
  EXPECT_EQ(press("--plots sections", "none").code, 2);
}

} // namespace
} // namespace palp
