#include "tests/app/commands/run_rig.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>

namespace palp
{
namespace
{

using namespace test;

TEST_F(RunCommand, GivesTheSameBytesTwice)
{
  ASSERT_EQ(press("--no-picture", "a").code, 0);
  ASSERT_EQ(press("--no-picture", "b").code, 0);
  const std::string first = test::readAll(folder_.path() / "a/samples.csv");
  EXPECT_GT(first.size(), 1000u);
  EXPECT_EQ(first, test::readAll(folder_.path() / "b/samples.csv"));
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

TEST_F(RunCommand, TellsAtWhichLevelAnImageWasRead)
{
  {
    constexpr int side = 50; // of the image; in it a ball of 25 mm, gray about its surface
    std::ofstream image(folder_.path() / "ball.mha", std::ios::binary);
    image << "ObjectType = Image\nNDims = 3\nBinaryData = True\nCompressedData = False\n"
             "ElementSpacing = 2 2 2\nOffset = 100 -30 7\nDimSize = 50 50 50\n"
             "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
    const auto fromMiddle = [](int i) { return 2.0 * i - 49.0; }; // [mm]
    for (int i = 0; i < side * side * side; ++i)
    {
      const double radius =
        std::hypot(fromMiddle(i % side), fromMiddle(i / side % side), fromMiddle(i / side / side));
      image.put(static_cast<char>(std::clamp(110.0 + 8.0 * (25.0 - radius), 0.0, 255.0)));
    }
  }
  const auto path = writePath(folder_.path(), "0,149,19,90\n0.1,149,19,77.5\n");
  const Finished finished = palp("run " + (folder_.path() / "ball.mha").string() +
    " --unit mm --level 110 --no-picture --path " + path.string() + " --out " +
    (folder_.path() / "out").string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  const std::string text = test::readAll(folder_.path() / "out/samples.csv");
  EXPECT_NE(text.find("level 110"), std::string::npos) << text.substr(0, 2000);
  // the middle is at 7 + 49 mm
  const auto depth = test::readCsv(folder_.path() / "out/samples.csv")["depth_mm"];
  EXPECT_NEAR(depth.back(), 81.0 - 77.5, 0.3);
}

TEST_F(RunCommand, ReplacesWhatIsThereOnlyWhenAsked)
{
  ASSERT_EQ(press("--no-picture", "out").code, 0);
  const auto file = folder_.path() / "out/samples.csv";
  const std::string before = test::readAll(file);
  const Finished refused = press("--no-picture --young 5kPa", "out");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("already; pass --overwrite"), std::string::npos);
  EXPECT_EQ(refused.err.find("deepest"), std::string::npos) << "after the press";
  EXPECT_EQ(test::readAll(file), before);
  std::ofstream(folder_.path() / "out/section.svg") << "of the run before";
  const Finished replaced = press("--no-picture --young 5kPa --overwrite", "out");
  EXPECT_EQ(replaced.code, 0);
  EXPECT_NE(
    replaced.err.find("will replace deformed.vtp, path.csv, presses.csv, provenance.json, "),
    std::string::npos)
    << replaced.err;
  EXPECT_NE(test::readAll(file), before);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/section.svg"));
}

TEST_F(RunCommand, ReplacesNoFileThatItReads)
{
  ASSERT_EQ(press("--no-picture", "out").code, 0);
  const std::filesystem::path out = folder_.path() / "out";
  for (const auto& [file, how] : { std::pair("deformed.vtp", " --at -48.5,38.4,39.5 "),
         std::pair("path.csv", " --path "), std::pair("samples.csv", " --path ") })
  {
    const std::string before = test::readAll(out / file);
    const Finished run = test::runCommand(PALP_PROGRAM " run" + std::string(how) +
      (out / file).string() + " --no-picture --overwrite --out " + out.string());
    EXPECT_EQ(run.code, 2) << file;
    EXPECT_NE(run.err.find(std::string(file) + ": is read by this run, which would replace it"),
      std::string::npos)
      << run.err;
    EXPECT_EQ(test::readAll(out / file), before);
  }
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
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out), {}), 9);
  }
}

// folders in which runs of some folder prepare their files
long stagesIn(const std::filesystem::path& folder)
{
  return std::ranges::count_if(std::filesystem::directory_iterator(folder),
    [](const auto& entry)
    { return entry.path().filename().string().find(".palp-") != std::string::npos; });
}

TEST_F(RunCommand, ASignalLeavesNothingBehind)
{
  const auto out = folder_.path() / "out";
  for (const char* signal : { "INT", "TERM", "HUP" })
  {
    const Finished ended = test::runCommand(PALP_PROGRAM " run --out " + out.string() +
      " 2>/dev/null & running=$!; until [ -e " + (folder_.path() / ".out.palp-").string() +
      "* ]; do :; done; kill -" + signal + " $running; wait $running"); // as early as can be
    EXPECT_GT(ended.code, 128) << signal;                               // as a shell tells it
    EXPECT_FALSE(std::filesystem::exists(out)) << signal;
    EXPECT_EQ(stagesIn(folder_.path()), 0) << signal;
  }
}

// what is left then goes with the next run beside it, but not what another is writing
TEST_F(RunCommand, ClearsWhatAKilledRunLeftBesideIt)
{
  const std::string run = PALP_PROGRAM " run --no-picture --out " + folder_.path().string();
  const auto begun = [&](const std::string& name)
  {
    return run + "/" + name + " >/dev/null 2>&1 & running=$!; until ls -d " +
      (folder_.path() / ("." + name + ".palp-")).string() +
      "* >/dev/null 2>&1; do sleep 0.01; done; ";
  };
  (void)test::runCommand(begun("killed") + "kill -KILL $running; wait $running");
  EXPECT_EQ(stagesIn(folder_.path()), 1);
  // stopped, so that it still writes while the next one runs
  const Finished both = test::runCommand(begun("slow") + "kill -STOP $running; " + run +
    "/next; echo $?; ls -d " + folder_.path().string() +
    "/.slow.palp-* | wc -l; kill -CONT $running; wait $running; echo $?");
  EXPECT_EQ(both.out, "0\n1\n0\n") << both.err;
  EXPECT_EQ(stagesIn(folder_.path()), 0);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "slow" / "samples.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "next" / "samples.csv"));
}

TEST_F(RunCommand, TwoAtOnceDoNotMix)
{
  const std::string out = (folder_.path() / "out").string();
  const std::string run = PALP_PROGRAM " run --out " + out;
  const Finished both = test::runCommand(run + " >/dev/null 2>&1 & running=$!; until ls -d " +
    (folder_.path() / ".out.palp-").string() +
    "* >/dev/null 2>&1 || ! kill -0 $running; do sleep 0.01; done; " + run +
    "; echo $?; wait $running; echo $?");
  EXPECT_EQ(both.out, "2\n0\n") << both.err;
  EXPECT_NE(both.err.find("another palp is writing there"), std::string::npos) << both.err;
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
  const std::regex deepest(R"("samples",(5|5\.0{9}\d*|4\.9{9}\d*),)"); // but for rounding
  EXPECT_TRUE(std::regex_search(test::readAll(again / "comparison.csv"), deepest));
  const test::CsvTable before = test::readCsv(samples);
  const test::CsvTable after = test::readCsv(again / "samples.csv");
  ASSERT_EQ(after["force_N"].size(), before["force_N"].size());
  for (std::size_t i = 0; i < before["force_N"].size(); ++i)
  {
    EXPECT_NEAR(after["force_N"][i], before["force_N"][i], 1e-9) << i;
  }
}

TEST_F(RunCommand, SaysThatAPathWasRecordedOnAnotherSurface)
{
  ASSERT_EQ(press("--no-picture", "first").code, 0);
  const std::string samples = " --path " + (folder_.path() / "first/samples.csv").string();
  const Finished same =
    palp("run " + block() + samples + " --no-picture --out " + (folder_.path() / "same").string());
  EXPECT_EQ(same.err.find("recorded on"), std::string::npos) << same.err;
  const Finished other = palp("run " PALP_SHARE "/meshes/sphere_50.vtp" + samples +
    " --no-picture --out " + (folder_.path() / "other").string());
  EXPECT_NE(other.err.find("recorded on block_50.vtp, another surface"), std::string::npos)
    << other.err;
}

// a press of 1.5 mm in 0.4 ms, between two samples; and one that stays away, row by millisecond
TEST_F(RunCommand, TellsOfRowsThatAreFinerThanTheSamples)
{
  const auto said = [&](double lowest, double wait, double before = 1.0)
  {
    std::ostringstream rows;
    rows << "0,0,0," << topMm() + 2 << "\n0.5,0,0," << topMm() + before << '\n'
         << 0.5 + 0.4 * wait << ",0,0," << topMm() + lowest << '\n'
         << 0.5 + 0.8 * wait << ",0,0," << topMm() + 1 << '\n';
    const Finished run = pressAlong(rows.str(), "--samples-only --overwrite", "out");
    EXPECT_EQ(run.code, 0) << run.err;
    return run.err;
  };
  const std::string fine = said(-1.5, 0.001);
  EXPECT_NE(fine.find("never touched"), std::string::npos) << fine;
  EXPECT_NE(fine.find("between whole milliseconds"), std::string::npos) << fine;
  const std::string coarse = said(0.5, 0.0025);
  EXPECT_NE(coarse.find("never touched"), std::string::npos) << coarse;
  EXPECT_EQ(coarse.find("milliseconds"), std::string::npos) << coarse;
  const std::string slow = said(-1.5, 0.1);
  EXPECT_EQ(slow.find("never touched"), std::string::npos);
  EXPECT_EQ(slow.find("milliseconds"), std::string::npos);
  const std::string touched = said(-1.5, 0.001, -1.0);
  EXPECT_EQ(touched.find("never touched"), std::string::npos) << touched;
  EXPECT_NE(touched.find("whole milliseconds"), std::string::npos) << touched;
}

TEST_F(RunCommand, TellsOfAnAxisThatPointsOutOfTheSurface)
{
  const auto said = [&](int axis)
  {
    std::ostringstream rows;
    rows << "time_s,x_mm,y_mm,z_mm,ax,ay,az\n0,0,0," << topMm() + 1 << ",0,0," << axis
         << "\n0.1,0,0," << topMm() - 2 << ",0,0," << axis << '\n';
    const std::filesystem::path path = folder_.path() / "press.csv";
    std::ofstream(path) << rows.str();
    const Finished run = palp("run " + block() + " --samples-only --overwrite --path " +
      path.string() + " --out " + (folder_.path() / "out").string());
    EXPECT_EQ(run.code, 0) << run.err;
    return run.err;
  };
  EXPECT_EQ(said(-1).find("axis"), std::string::npos);
  EXPECT_NE(said(1).find("axis points out of the surface"), std::string::npos);
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

} // namespace
} // namespace palp
