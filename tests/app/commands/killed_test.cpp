#include "tests/app/commands/victim.h"
#include "tests/support/process.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <thread>

// Every command that writes, killed at random moments, and stopped before all that it does to a
// file: what is there then is what a kill until the next one leaves.

namespace palp
{
namespace
{

using test::Files;
using test::filesIn;
using test::restore;
using test::Stepped;
using test::Victim;
using Clock = std::chrono::steady_clock;

constexpr std::array kOtherParts{ "force_error", "surface_error", "tissue_error", "organ_error",
  "curvature", "inclination", "extents", "dynamics", "scaling", "forces", "stability", "servo" };
constexpr unsigned kChanges = 120; // of the files of a report

#ifdef PALP_SLOW
constexpr int kUsual = 1000;
constexpr std::chrono::minutes kLongest{ 12 }; // for one command, whose runs may take seconds
#else
constexpr int kUsual = 2;
constexpr std::chrono::minutes kLongest{ 1 };
#endif

int asked(const char* variable, int usual)
{
  const char* value = std::getenv(variable);
  return value ? std::atoi(value) : usual;
}

int kills()
{
  return asked("PALP_KILLS", kUsual);
}

// the same each time, unless asked for others
std::mt19937 moments()
{
  return std::mt19937(static_cast<unsigned>(asked("PALP_MOMENTS", 1)));
}

constexpr const char* kBefore = "\nof the run before"; // ends each file of that

class Killed : public testing::Test
{
protected:
  /// A command that replaces all of a folder.
  /// @param isWhole  of the files: those before and those of a run that nobody killed are
  void killOften(
    const std::string& command,
    const std::function<bool(const Files&)>& isWhole = [](const Files&) { return false; })
  {
    killAnyOften(command + " --overwrite --out " + out_.string(), isWhole);
  }

  /// One that writes into that folder of itself.
  void killAnyOften(
    const std::string& command,
    const std::function<bool(const Files&)>& isWhole = [](const Files&) { return false; })
  {
    const std::string full = PALP_PROGRAM " " + command;
    const auto start = Clock::now();
    ASSERT_EQ(test::runCommand(full).code, 0);
    const std::chrono::duration<double> duration = Clock::now() - start;
    const Files fresh = filesIn(out_);
    ASSERT_FALSE(fresh.empty());
    Files old = fresh;
    for (auto& [name, text] : old)
    {
      text += kBefore;
    }
    int news = 0;
    const auto isSound = [&]
    {
      const Files now = filesIn(out_);
      news += now != old ? 1 : 0;
      return now == old || now == fresh || isWhole(now);
    };
    restore(out_, old);
    int changes = 0;
    for (Stepped run(full, folder_.path()); run.next(); ++changes)
    {
      ASSERT_TRUE(isSound()) << "before change " << changes;
    }
    ASSERT_GT(changes, 2);
    std::mt19937 random = moments();
    std::uniform_real_distribution<double> fraction(0.0, 1.0);
    news = 0;
    int kill = 0;
    for (; kill < kills() && Clock::now() - start < kLongest; ++kill)
    {
      restore(out_, old);
      if (kill % 2 == 0)
      {
        const Victim victim(full);
        std::this_thread::sleep_for(1.2 * fraction(random) * duration);
      }
      else // where files change is where a kill tells most
      {
        Stepped victim(full, folder_.path());
        for (int left = static_cast<int>(random() % static_cast<unsigned>(changes));
             left >= 0 && victim.next(); --left)
        {
        }
      }
      ASSERT_TRUE(isSound()) << "after kill " << kill;
    }
    std::printf(
      "looked at before each of %d changes; %d kills of a run of %.2f s: %d left the files "
      "before, %d new ones\n",
      changes, kill, duration.count(), kill - news, news);
    ASSERT_EQ(test::runCommand(full).code, 0);
    EXPECT_EQ(filesIn(out_), fresh);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
  }

  test::TemporaryFolder folder_;
  test::TemporaryFolder made_; // what a command reads
  std::filesystem::path out_ = folder_.path() / "out";
};

TEST_F(Killed, RunOfDataOnly)
{
  killOften("run --no-picture");
}

TEST_F(Killed, RunWithPictures)
{
  killOften("run --plots force-time,section --plot-files png,csv");
}

TEST_F(Killed, RunAtPlaces)
{
  killOften("run --no-picture --at -48.5,38.4,39.5 --depth 3mm");
}

TEST_F(Killed, RunOfAFolderAgain)
{
  const std::string made = (made_.path() / "made").string();
  ASSERT_EQ(test::runCommand(PALP_PROGRAM " run --no-picture --out " + made).code, 0);
  killOften("run " + made);
}

TEST_F(Killed, Fit)
{
  const std::string curve = (made_.path() / "curve.csv").string();
  ASSERT_EQ(
    test::runCommand(PALP_PROGRAM " force --tip sphere:4mm --poisson 0.45 > " + curve).code, 0);
  killOften("fit " + curve + " --tip sphere:4mm --poisson 0.45");
}

TEST_F(Killed, Scene)
{
  killOften("scene block_force");
}

TEST_F(Killed, Phantom)
{
  killOften("phantom sphere --voxel 4mm");
}

TEST_F(Killed, Import)
{
  const std::string made = (made_.path() / "made").string();
  ASSERT_EQ(test::runCommand(PALP_PROGRAM " phantom slab --voxel 4mm --out " + made).code, 0);
  killOften("import " + made + "/slab.mha --names " + made + "/slab.ctbl");
}

TEST_F(Killed, Map)
{
  killOften("map " PALP_SHARE "/meshes/block_50.vtp --depth 2mm --spacing 20mm");
}

TEST_F(Killed, Check)
{
  std::filesystem::create_directory(out_);
  killAnyOften("check " PALP_SHARE "/meshes/sphere_30.vtp --overwrite --faults " +
    (out_ / "faults.vtp").string() + " --repair " + (out_ / "clean.vtp").string());
}

// a plan of ten thousand cases, and a merge of forty
TEST_F(Killed, SweepPlanAndMerge)
{
  const auto sweep = [&](const char* name, int steps)
  {
    const std::string file = (made_.path() / name).string();
    std::ofstream(file)
      << R"({"palp_sweep": 1, "kind": "force", "fixed": {"depth": "1:1:1mm"}, "grid": {"poisson":
         [0.3, 0.4], "young": {"from": "1kPa", "to": "9kPa", "count": )"
      << steps << "}}}";
    return file;
  };
  killAnyOften("sweep plan " + sweep("many.json", 5000) + " " + out_.string());
  const std::string folder = (made_.path() / "few").string();
  ASSERT_EQ(
    test::runCommand(PALP_PROGRAM " sweep plan " + sweep("few.json", 20) + " " + folder).code, 0);
  ASSERT_EQ(test::runCommand(PALP_PROGRAM " sweep run " + folder).code, 0);
  std::filesystem::remove_all(out_);
  std::filesystem::create_directory(out_);
  killAnyOften("sweep merge " + folder + " --overwrite --out " + (out_ / "all.vtt").string());
}

#ifdef PALP_SLOW // seconds for each run
TEST_F(Killed, Stability)
{
  killOften("stability --quick");
}
#endif

TEST_F(Killed, Experiment)
{
  killOften("experiment inclination profiles --quick");
}

// the depths so far, all of the new case
bool isNewCase(const Files& files)
{
  return std::ranges::none_of(
           files, [](const auto& file) { return file.second.ends_with(kBefore); }) &&
    files.contains("table.csv") && files.contains("profiles.csv") && files.contains("fit.json");
}

TEST_F(Killed, Calibration)
{
  killOften("calibrate --no-picture --element-size 1mm --depth 1:3:0.5mm", isNewCase);
}

// minutes each, of which the last moment alone writes: what was there stays
TEST_F(Killed, Tables)
{
  const Files old{ { "sphere_r10_h50.csv", "mine" }, { "other.txt", "mine" } };
  restore(out_, old);
  std::mt19937 random = moments();
  std::uniform_real_distribution<double> wait(0.0, 2.0);
  for (int i = 0; i < kills(); ++i)
  {
    {
      const Victim victim(PALP_PROGRAM " calibrate --overwrite --tables " + out_.string());
      std::this_thread::sleep_for(std::chrono::duration<double>(wait(random)));
    }
    ASSERT_EQ(filesIn(out_), old) << "after kill " << i;
  }
}

// of whole files of a report
bool isCut(const Files::value_type& file)
{
  const auto& [name, text] = file;
  const auto ends = [&](const char* extension, const char* end)
  { return name.ends_with(extension) && !text.ends_with(end); };
  return text.empty() || ends(".json", "}\n") || ends(".csv", "\n") || ends(".svg", "</svg>\n") ||
    ends(".html", "</html>\n");
}

// whether a command ends before it is killed, after 20 ms to 40 s, alike for each factor of time
bool endsBefore(const std::string& command, std::mt19937& random)
{
  const Victim victim(command);
  const double wait = 0.02 * std::pow(2000.0, std::uniform_real_distribution<>()(random)); // [s]
  for (const auto start = Clock::now();
       !victim.ended() && Clock::now() - start < std::chrono::duration<double>(wait);)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return victim.ended();
}

// A part anew in the place of an old report, or added to one. Its writing is walked through with
// the part that takes no time, its computing is cut off at any moment of any part.
TEST_F(Killed, Report)
{
  const std::string command = PALP_PROGRAM " report --quick --out " + out_.string() + " ";
  ASSERT_EQ(test::runCommand(command + "profiles").code, 0);
  const Files some = filesIn(out_);
  const auto isKept = [&](const Files& files)
  {
    return std::ranges::all_of(some,
      [&](const auto& file)
      {
        const bool isNew = file.first == "report.html" || file.first.starts_with("claims");
        return isNew || (files.contains(file.first) && files.at(file.first) == file.second);
      });
  };
  const auto isGone = [](const Files& files)
  {
    return std::ranges::none_of(
      files, [](const auto& file) { return file.first.starts_with("profiles"); });
  };
  std::mt19937 random = moments();
  int looks = 0;
  int finished = 0;
  int unchanged = 0;
  int kill = 0;
  for (const auto start = Clock::now(); kill < kills() && Clock::now() - start < 4 * kLongest;
       ++kill)
  {
    const bool goesOn = (kill + kill / 4) % 2 == 1;
    const auto isSound = [&]
    {
      const Files now = filesIn(out_);
      unchanged += now == some ? 1 : 0;
      return std::ranges::none_of(now, isCut) && (isKept(now) || (!goesOn && isGone(now)));
    };
    restore(out_, some);
    const std::string how = goesOn ? "--resume " : "--overwrite ";
    if (kill % 4 < 3)
    {
      Stepped victim(command + how + "inclination", folder_.path());
      bool isRunning = true;
      for (auto left = random() % kChanges; left > 0 && (isRunning = victim.next());
           --left, ++looks)
      {
        ASSERT_TRUE(isSound()) << "in run " << kill;
      }
      finished += isRunning ? 0 : 1;
    }
    else
    {
      finished +=
        endsBefore(command + how + kOtherParts[random() % kOtherParts.size()], random) ? 1 : 0;
    }
    ASSERT_TRUE(isSound()) << "after kill " << kill;
  }
  std::printf("%d kills and %d looks between changes: %d found the files before; %d reports "
              "finished\n",
    kill, looks, unchanged, finished);
}

} // namespace
} // namespace palp
