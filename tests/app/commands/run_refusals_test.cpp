#include "tests/app/commands/run_rig.h"

#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace test;

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

// the block of 50 mm
TEST_F(RunCommand, RefusesCoatingsThatLeaveNothingOfTheBody)
{
  const std::string coated = "--no-picture --law corrected --coating ";
  const Finished finished = press(coated + "50mm:20kPa:0.45", "none");
  EXPECT_EQ(finished.code, 2) << finished.err;
  EXPECT_NE(finished.err.find("nothing is left below"), std::string::npos) << finished.err;
  EXPECT_EQ(press(coated + "30mm:20kPa:0.45", "some").code, 0);
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

TEST_F(RunCommand, ShowsNoControlCharacterOfAFile)
{
  const auto path = writePath(folder_.path(), "\033]0;owned\007,1,2,3\n");
  const Finished finished = palp(
    "run --no-picture --path " + path.string() + " --out " + (folder_.path() / "out").string());
  EXPECT_EQ(finished.code, 2);
  EXPECT_EQ(finished.err.find_first_of("\033\007"), std::string::npos) << finished.err;
}

} // namespace
} // namespace palp
