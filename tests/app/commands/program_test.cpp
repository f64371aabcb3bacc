#include "tests/app/commands/run_rig.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <regex>

namespace palp
{
namespace
{

using namespace test;

TEST(Program, HelpsByWordAndNamesTheCommands)
{
  for (const char* arguments : { "help", "--help", "help run", "run --help" })
  {
    const Finished finished =
      runCommand(std::string("env -u DISPLAY -u WAYLAND_DISPLAY " PALP_PROGRAM " ") + arguments);
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

// of a patient's image, where coordinates go in
TEST(Program, TellsTheFrameOfCoordinates)
{
  for (const char* command : { "run", "view" })
  {
    const Finished help = palp(std::string(command) + " --help");
    EXPECT_NE(help.out.find("LPS"), std::string::npos) << command;
  }
}

TEST(Program, IsRunByTheReadmesFirstCommand)
{
  const std::filesystem::path built = PALP_SOURCE_DIR "/.build/release/bin/palp";
  if (!std::filesystem::exists(built) || !std::filesystem::equivalent(built, PALP_PROGRAM))
  {
    GTEST_SKIP() << "built elsewhere";
  }
  const test::TemporaryFolder folder;
  const Finished finished = test::runCommand(
    "cd " + folder.path().string() + " && " PALP_SOURCE_DIR "/app/run --headless --out x");
  EXPECT_EQ(finished.code, 0) << finished.err;
  for (const char* file : { "samples.csv", "deformed.vtp", "press.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "x" / file)) << file;
  }
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

// an installation from which the programs for pictures and window were left out
TEST(Program, WithoutItsSiblingsNamesTheMissingOneAndGoesOnWithoutPictures)
{
  const test::TemporaryFolder folder;
  const std::filesystem::path bin = folder.path() / "bin";
  std::filesystem::create_directories(bin);
  std::filesystem::copy_file(PALP_PROGRAM, bin / "palp");
  const auto run = [&](const std::string& arguments)
  {
    return test::runCommand("cd " + folder.path().string() +
      " && PALP_DATA=" PALP_SHARE " DISPLAY=:0 bin/palp " + arguments);
  };
  const std::string experiment = "experiment inclination --quick --out out";
  for (const auto& [arguments, sibling] :
    { std::pair(experiment, "palp-draw"), std::pair(std::string("view"), "palp-view"),
      std::pair(std::string("devices"), "palp-devices") })
  {
    const Finished refused = run(arguments);
    EXPECT_NE(refused.code, 0) << arguments;
    EXPECT_NE(
      refused.err.find("/bin/" + std::string(sibling) + ": cannot be started"), std::string::npos)
      << refused.err;
    EXPECT_EQ(test::sentences(refused).size(), 1U) << refused.err;
  }
  EXPECT_EQ(run(experiment + " --no-picture").code, 0);
}

TEST(Program, RefusesAScaleAClutchOrHandsThatNoDeviceHas)
{
  for (const auto& [options, fix] : { std::pair("--device-scale 9", "0.2 to 5"),
         std::pair("--device-scale nan", "--device-scale"), std::pair("--clutch 1.5", "0 to 32"),
         std::pair("--clutch 33", "0 to 32"), std::pair("--clutch 1 --dead-man", "give another"),
         std::pair("--device falcon --device falcon", "name another device"),
         std::pair("--device falcon --device mouse", "give it first"),
         std::pair("--device mouse --device falcon --device haply", "give one or two") })
  {
    const Finished finished = palp(std::string("view ") + options);
    EXPECT_EQ(finished.code, 2) << options;
    EXPECT_NE(finished.err.find(fix), std::string::npos) << finished.err;
    EXPECT_EQ(test::sentences(finished).size(), 1U) << finished.err;
  }
}

TEST(Program, ShowsNoControlCharacterOfAnOption)
{
  const Finished finished = palp("force --law \"$(printf '\\033[31m')\"");
  EXPECT_EQ(finished.code, 2);
  EXPECT_EQ(finished.err.find('\033'), std::string::npos) << finished.err;
  EXPECT_EQ(finished.err.rfind("palp: --law", 0), 0U) << finished.err;
}

TEST(Program, IsHardenedLikeAllBesideIt)
{
  for (const char* name :
    { "palp", "palp-read", "palp-read-dicom", "palp-draw", "palp-view", "palp-devices" })
  {
    const auto file = std::filesystem::path(PALP_PROGRAM).parent_path() / name;
    const Finished told = test::runCommand("readelf -hldW --dyn-syms " + file.string());
    ASSERT_EQ(told.code, 0) << told.err;
    EXPECT_TRUE(std::regex_search(told.out, std::regex("Type: +DYN"))) << name; // PIE
    EXPECT_NE(told.out.find("GNU_RELRO"), std::string::npos) << name;
    EXPECT_NE(told.out.find("BIND_NOW"), std::string::npos) << name;
    EXPECT_NE(told.out.find("__stack_chk_fail"), std::string::npos) << name;
    EXPECT_TRUE(std::regex_search(told.out, std::regex("__[a-z]+_chk@"))) << name; // fortified
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

} // namespace
} // namespace palp
