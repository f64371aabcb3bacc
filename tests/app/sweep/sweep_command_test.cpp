#include "tests/app/commands/victim.h"
#include "tests/app/sweep/file_events.h"
#include "tests/app/sweep/sweep_rig.h"

#include <cstdlib>
#include <functional>
#include <random>
#include <tuple>

// one sweep computed in several ways, and what must not be

namespace palp
{
namespace
{

using test::Finished;
using test::sweep;
using test::Sweeping;

#ifdef PALP_SLOW
constexpr int kUsual = 100;
#else
constexpr int kUsual = 4;
#endif

// PALP_KILLS sets another number
int kills()
{
  const char* asked = std::getenv("PALP_KILLS");
  return asked ? std::atoi(asked) : kUsual;
}

class KilledSweeping : public Sweeping
{
protected:
  /// kill -9 of workers and of the master at moments of the work, which then goes on.
  /// @param command  for a folder
  void killOften(const std::function<std::string(const std::string& where)>& command) const
  {
    plan("grid.json", "serial");
    ASSERT_EQ(sweep("run --jobs 2 " + at("serial")).code, 0);
    std::mt19937 random(1); // the same choices each time
    std::string where;
    Results before;
    for (int i = 0; i < kills(); ++i)
    {
      if (i % 10 == 0) // else most is done; what parallel started lives on in the folder before
      {
        where = "killed" + std::to_string(i);
        plan("grid.json", where, "--parallel");
        before.clear();
      }
      test::FileEvents events(folder() / where);
      const test::Victim victim(command(at(where)));
      events.wait(static_cast<int>(random() % 40), victim);
      if (i % 2 == 0)
      {
        killWorker(where, i % 4 == 0);
        events.wait(static_cast<int>(random() % 10), victim);
      } // and all of them at the end of the victim
      const Results now = results(where);
      for (const auto& [name, text] : before)
      {
        ASSERT_EQ(now.at(name), text) << "computed again after it was finished";
      }
      before = now;
    }
    const Finished last = test::runCommand(command(at(where)));
    EXPECT_EQ(last.code, 0) << last.err;
    EXPECT_EQ(merged(where), merged("serial"));
  }
};

TEST_F(Sweeping, SerialEqualsTheCommandsByThemselves)
{
  plan("grid.json", "serial");
  const Finished first = counted("run " + at("serial"));
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(starts(), kCases);
  const Finished again = counted("run " + at("serial"));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(starts(), kCases); // nothing twice
  EXPECT_NE(sweep("status " + at("serial")).out.find("40 of 40 cases done, 0 running, 0 failed"),
    std::string::npos);

  std::string expected =
    "poisson,radius_mm,depth_mm,force_N,contact_radius_mm,stiffness_N_per_mm\n";
  for (const std::string poisson : { "0.3", "0.35", "0.4", "0.45", "0.5" })
  {
    for (int radius = 1; radius <= 8; ++radius)
    {
      const std::string digits = std::to_string(radius);
      const Finished alone = test::runCommand(PALP_PROGRAM " force --depth 1:1:1mm --poisson " +
        poisson + " --tip sphere:" + digits + "mm");
      expected += poisson + "," + digits + "," + alone.out.substr(alone.out.find('\n') + 1);
    }
  }
  EXPECT_EQ(merged("serial"), expected);
}

TEST_F(Sweeping, ComputesDamagedResultsAgainWhereItIsAskedTo)
{
  plan("grid.json", "grid");
  ASSERT_EQ(sweep("run --jobs 2 " + at("grid")).code, 0);
  const std::string before = merged("grid");
  std::vector<std::filesystem::path> places;
  for (const auto& part : std::filesystem::directory_iterator(folder() / "grid/results"))
  {
    places.push_back(std::filesystem::directory_iterator(part.path())->path());
  }
  ASSERT_GT(places.size(), 4U);
  std::filesystem::remove(places[0] / "case.json");
  std::ofstream(places[1] / "force.csv") << "depth_mm,force_N\n";
  std::filesystem::remove(places[2] / "force.csv");
  std::filesystem::copy(places[4], places[3],
    std::filesystem::copy_options::overwrite_existing | std::filesystem::copy_options::recursive);
  EXPECT_EQ(counted("run " + at("grid")).code, 0);
  EXPECT_EQ(starts(), 1); // what is no result
  expectRefused("merge " + at("grid") + " --out " + at("x.csv"), "run DIR --check");
  EXPECT_EQ(counted("run --check " + at("grid")).code, 0);
  EXPECT_EQ(starts(), 1 + 3);
  EXPECT_EQ(merged("grid"), before);
}

TEST_F(Sweeping, TwoShardsInTwoFoldersMakeTheSame)
{
  plan("grid.json", "serial");
  ASSERT_EQ(sweep("run --jobs 2 " + at("serial")).code, 0);
  plan("grid.json", "one");
  plan("grid.json", "two");
  ASSERT_EQ(counted("run --shard 1/2 " + at("one")).code, 0);
  ASSERT_EQ(counted("run --shard 2/2 " + at("two")).code, 0);
  EXPECT_EQ(starts(), kCases);
  EXPECT_EQ(sweep("merge " + at("one") + " --out " + at("one.csv")).code, 5);
  EXPECT_EQ(merged("one " + at("two")), merged("serial"));
}

TEST_F(Sweeping, TwoRunnersAtOnceDoEachCaseOnce)
{
  plan("grid.json", "both");
  const Finished both = test::runCommand(counting() + " run " + at("both") + " --jobs 2 & " +
    counting() + " run " + at("both") + "; first=$?; wait $! && [ $first = 0 ]");
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_EQ(starts(), kCases);
}

TEST_F(Sweeping, ArrayTasksTakeTheirChunks)
{
  plan("grid.json", "array");
  for (const char* task : { "0", "1", "2" }) // 15, 15 and 10 cases
  {
    ASSERT_EQ(test::runCommand("SLURM_ARRAY_TASK_ID=" + std::string(task) + " " + counting() +
                " run --chunk 15 " + at("array"))
                .code,
      0);
  }
  EXPECT_EQ(starts(), kCases);
  EXPECT_EQ(sweep("run --chunk 15 --case 3 " + at("array")).code, 2);
}

TEST_F(KilledSweeping, ByParallelMakesTheSame)
{
  ASSERT_EQ(test::runCommand("command -v parallel").code, 0) << "app/setup.sh installs it";
  killOften([](const std::string& where) { return "sh " + where + "/parallel.sh -j 2"; });
}

TEST_F(KilledSweeping, ByJobsMakesTheSame)
{
  killOften([](const std::string& where) { return PALP_PROGRAM " sweep run --jobs 2 " + where; });
}

TEST_F(Sweeping, NamesAFailedCaseWithItsLogAndGoesOn)
{
  write("good.csv", "time_s,depth_mm\n0,0\n1,2\n"); // nobody reads them before
  write("bad.csv", "time_s,depth_mm\n0,0\n0,2\n");
  write("some.json", R"({"palp_sweep": 1, "kind": "force",
    "grid": {"history": ["good.csv", "bad.csv"]}})");
  plan("some.json", "some");
  const Finished run = sweep("run " + at("some"));
  EXPECT_EQ(run.code, 5);
  EXPECT_NE(run.err.find("case 1: "), std::string::npos) << run.err;
  const Finished status = sweep("status " + at("some"));
  EXPECT_NE(status.out.find("1 of 2 cases done, 0 running, 1 failed"), std::string::npos)
    << status.out;
  const std::size_t log = status.out.find(at("some/failed/"));
  ASSERT_NE(log, std::string::npos) << status.out;
  const std::string file = status.out.substr(log, status.out.find(')', log) - log);
  EXPECT_NE(test::readAll(file).find("palp: "), std::string::npos);
  EXPECT_EQ(sweep("merge " + at("some") + " --out " + at("some.csv")).code, 5);
  EXPECT_EQ(sweep("merge --partial " + at("some") + " --out " + at("some.csv")).code, 0);
}

// a sphere three quarters into a layer; its sentence names the folder of the depths before
TEST_F(Sweeping, KeepsWhatAFailedCaseReached)
{
  write("deep.json", R"({"palp_sweep": 1, "kind": "calibrate", "fixed": {"block": "60x60x20mm",
    "element-size": "2mm", "depth": "8:15.5:7.5mm"}, "grid": {"tip": ["sphere:10mm"]}})");
  plan("deep.json", "deep");
  EXPECT_EQ(sweep("run " + at("deep")).code, 5);
  const std::string status = sweep("status " + at("deep")).out;
  const std::string begin = "(1 of 2 depths are in ";
  const std::size_t place = status.find(begin) + begin.size();
  ASSERT_NE(place, begin.size() - 1) << status;
  const std::filesystem::path reached = status.substr(place, status.find(')', place) - place);
  EXPECT_NE(test::readAll(reached / "table.csv").find("\n8,"), std::string::npos) << status;
}

// a file beside the sweep, whatever option names it, and whatever lies where the user stands
TEST_F(Sweeping, FilesStandBesideTheSweepAndAreOfItsCases)
{
  const std::string head = "# CoordinateSystem = LPS\n";
  write("points.fcsv", head + "0,0,0,0\n");
  write("late.csv", "time_s,depth_mm\n0,0\n1,2\n");
  write("at.json",
    R"({"palp_sweep": 1, "kind": "run", "fixed": {"mesh": ")" PALP_SHARE
    R"(/meshes/block_50.vtp", "points": "points.fcsv"}})");
  write("late.json", R"({"palp_sweep": 1, "kind": "force", "fixed":
    {"history": "late.csv", "relaxation": "0.3:50ms", "law": "corrected"}})");
  for (const auto& [sweep, file, other] : { std::tuple("at", "points.fcsv", head + "0,5,5,0\n"),
         std::tuple("late", "late.csv", std::string("time_s,depth_mm\n0,0\n1,5\n")) })
  {
    plan(sweep + std::string(".json"), sweep);
    ASSERT_EQ(test::sweep("run " + at(sweep)).code, 0) << sweep;
    const std::string first = merged(sweep);
    write(file, other);
    const Finished late =
      test::sweep("merge " + at(sweep) + " --overwrite --out " + at("late_too.csv"));
    EXPECT_NE(late.err.find(std::string(file) + ": was edited after planning"), late.err.npos)
      << late.err;
    plan(sweep + std::string(".json"), sweep);
    ASSERT_EQ(test::sweep("run " + at(sweep)).code, 0) << sweep;
    EXPECT_NE(merged(sweep), first) << "another case";
    std::filesystem::remove(folder() / file);
    expectRefused("plan " + at(sweep + std::string(".json")) + " " + at("none"), file);
  }
}

TEST_F(Sweeping, TellsOfWarnings)
{
  write("deep.json", R"({"palp_sweep": 1, "kind": "force", "fixed": {"depth": "0:50:10mm"},
    "grid": {"tip": ["sphere:4mm"]}})");
  plan("deep.json", "deep");
  const Finished run = sweep("run " + at("deep"));
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.err.find("1 case computed with a warning, as case 0, see " + at("deep/results/")),
    std::string::npos)
    << run.err;
}

// the log of GNU parallel counts cases, which are others now
TEST_F(Sweeping, PlannedAnewForgetsTheScriptsOfThePlanBefore)
{
  plan("grid.json", "grid", "--parallel --slurm");
  write("grid/parallel.log", "as GNU parallel leaves it");
  const auto there = [&](const char* file)
  { return std::filesystem::exists(folder() / "grid" / file); };
  plan("grid.json", "grid");
  EXPECT_TRUE(there("parallel.sh") && there("parallel.log") && there("sweep.sbatch"));
  write("grid.json", R"({"palp_sweep": 1, "kind": "force", "fixed": {"depth": "1:1:1mm"},
    "grid": {"poisson": [0.3, 0.35, 0.4]}})");
  plan("grid.json", "grid", "--parallel");
  EXPECT_FALSE(there("parallel.log") || there("sweep.sbatch"));
  ASSERT_EQ(test::runCommand("sh " + at("grid/parallel.sh")).code, 0);
  EXPECT_NE(sweep("status " + at("grid")).out.find("3 of 3 cases done"), std::string::npos);
}

TEST_F(Sweeping, WritesAScriptForSlurmByAPilotCase)
{
  plan("grid.json", "slurm", "--slurm --tasks 7");
  const std::string script = test::readAll(folder() / "slurm/sweep.sbatch");
  for (const char* line : { "#SBATCH --array=0-6\n", "#SBATCH --requeue\n",
         "#SBATCH --mem=", "#SBATCH --time=0:05:00\n", " --chunk 6\n" })
  {
    EXPECT_NE(script.find(line), std::string::npos) << line << script;
  }
  EXPECT_NE(sweep("status " + at("slurm")).out.find("3 of 40 cases done"), std::string::npos);
  for (int task = 0; task < 7; ++task)
  {
    ASSERT_EQ(test::runCommand(
                "SLURM_ARRAY_TASK_ID=" + std::to_string(task) + " sh " + at("slurm/sweep.sbatch"))
                .code,
      0);
  }
  EXPECT_NE(sweep("status " + at("slurm")).out.find("40 of 40"), std::string::npos);
}

} // namespace
} // namespace palp
