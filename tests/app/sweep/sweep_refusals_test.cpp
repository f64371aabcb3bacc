#include "tests/app/sweep/sweep_rig.h"

// what nobody may lose, and what is told instead

namespace palp
{
namespace
{

using test::Finished;
using test::sweep;
using test::Sweeping;

TEST_F(Sweeping, RefusesWhatWasEditedAfterPlanning)
{
  write("tip.csv", "radius_mm,height_mm\n0,0\n1,0.1\n2,0.5\n4,2\n");
  write("file.json",
    R"({"palp_sweep": 1, "kind": "force", "fixed": {"depth": "1:1:1mm", "law": "exact"},
    "grid": {"tip": ["profile:tip.csv", "sphere:5mm"]}})");
  plan("file.json", "file");
  ASSERT_EQ(sweep("run --case 1 " + at("file")).code, 0);
  write("tip.csv", "radius_mm,height_mm\n0,0\n1,0.2\n2,0.8\n4,3\n");
  expectRefused("run " + at("file"), "tip.csv: was edited after planning");
  plan("file.json", "file"); // the other case stays
  ASSERT_EQ(counted("run " + at("file")).code, 0);
  EXPECT_EQ(starts(), 1);

  std::string cases = test::readAll(folder() / "file/cases.csv");
  const auto edit = [&](const std::string& from, const std::string& to)
  {
    std::string edited = cases;
    edited.replace(edited.find(from), from.size(), to);
    write("file/cases.csv", edited);
  };
  edit("sphere:5mm\n", "sphere:6mm\n");
  expectRefused(
    "merge " + at("file") + " --out " + at("x.csv"), "case 1 was edited after planning");
  std::filesystem::remove_all(folder() / "file/results");
  expectRefused("run --case 1 " + at("file"), "case 1 was edited after planning");
  edit("palp sweep 1", "palp sweep 2");
  expectRefused("run " + at("file"), "another version");
  edit(R"("palp":")", R"("palp":"9)");
  expectRefused("run " + at("file"), "was planned by palp 9");
  edit(R"("kind")", R"("kinds")");
  expectRefused("status " + at("file"), "damaged");
}

TEST_F(Sweeping, MergesOverNoFileOfItsOwn)
{
  plan("grid.json", "grid");
  ASSERT_EQ(sweep("run --jobs 2 " + at("grid")).code, 0);
  const std::string before = merged("grid");
  const std::string result =
    std::filesystem::recursive_directory_iterator(folder() / "grid/results")->path().string();
  for (const std::string& own : { at("grid/cases.csv"), result + "/force.csv",
         at("grid/../grid/cases.csv"), at("grid/running/x.csv") })
  {
    expectRefused("merge " + at("grid") + " --overwrite --out " + own, "choose another --out");
  }
  write("mine.csv", "mine");
  expectRefused("merge " + at("grid") + " --out " + at("mine.csv"), "pass --overwrite");
  EXPECT_EQ(test::readAll(at("mine.csv")), "mine");
  EXPECT_EQ(merged("grid"), before);
  EXPECT_EQ(sweep("merge " + at("grid") + " --out " + at("grid/all.csv")).code, 0);
}

// by somebody else, and taken back, so that no look before or after sees it
TEST_F(Sweeping, KeepsNoResultOfAFileThatWasTouchedMeanwhile)
{
  const std::string mine = "radius_mm,height_mm\n0,0\n1,0.1\n2,0.5\n4,2\n";
  write("tip.csv", mine);
  write("mine.csv", mine);
  write("other.csv", "radius_mm,height_mm\n0,0\n1,0.2\n2,0.8\n4,3\n");
  write("tip.json", R"({"palp_sweep": 1, "kind": "force", "fixed": {"depth": "1:1:1mm",
    "law": "exact", "tip": "profile:tip.csv"}, "grid": {"poisson": [0.1, 0.2, 0.3, 0.4]}})");
  plan("tip.json", "tip");
  countStarts("[ -e " + at("done") + " ] || cp " + at("other.csv") + " " + at("tip.csv"));
  const Finished touched = counted("run " + at("tip"));
  EXPECT_EQ(touched.code, 2);
  EXPECT_NE(touched.err.find("tip.csv: was edited while case 0 was computed"), std::string::npos)
    << touched.err;
  EXPECT_TRUE(results("tip").empty());
  std::filesystem::copy_file(
    at("mine.csv"), at("tip.csv"), std::filesystem::copy_options::overwrite_existing);
  write("done", "");
  EXPECT_EQ(counted("run " + at("tip")).code, 0);
  expectRefused("merge " + at("tip") + " --out " + at("tip.csv"), "choose another --out");
  EXPECT_EQ(test::readAll(at("tip.csv")), mine);
}

// each of its cases would be computed twice under one name
TEST_F(Sweeping, PlansNoValueTwice)
{
  const std::string begin = R"({"palp_sweep": 1, "kind": "force", "fixed": {"depth": "1:1:1mm"}, )";
  const auto refuses = [&](const std::string& axes, const std::string& words)
  {
    write("equal.json", begin + axes + "}");
    expectRefused("plan " + at("equal.json") + " " + at("equal"), words);
    EXPECT_FALSE(std::filesystem::exists(folder() / "equal"));
  };
  refuses(R"("grid": {"young": ["5kPa", "7kPa", "5kPa"]})",
    "equal.json: 'young': its values 1 and 3 are equal, '5kPa'; each case would be computed twice");
  refuses(R"("grid": {"young": ["5kPa", "5.0 kPa"]})", "1 and 2 are equal");
  refuses(R"("grid": {"law": ["exact", "paper", "paper"]})", "2 and 3 are equal");
  refuses(R"("zip": {"young": ["5kPa", "7kPa", "5kPa"], "poisson": [0.3, 0.3, 0.30]})",
    "'poisson': its values 1 and 3 are equal, '0.3', and so is all that goes with it");
  write("zip.json",
    begin + R"("zip": {"young": ["5kPa", "7kPa", "5kPa"], "poisson": [0.3, 0.3, 0.4]}})");
  plan("zip.json", "zip");
}

TEST_F(Sweeping, PlansOverNoFileOfOthers)
{
  write("project/cases.csv", "mine");
  expectRefused("plan " + at("grid.json") + " " + at("project"), "is no plan of a sweep");
  EXPECT_EQ(test::readAll(folder() / "project/cases.csv"), "mine");
}

// who waits for what nobody writes, or reads without an end, plans nothing
TEST_F(Sweeping, TakesNoPipeOrDeviceForAFile)
{
  ASSERT_EQ(test::runCommand("mkfifo " + at("tip.csv")).code, 0);
  write("pipe.json", R"({"palp_sweep": 1, "kind": "force", "fixed": {"history": "tip.csv",
    "relaxation": "0.3:50ms", "law": "corrected"}})");
  expectRefused("plan " + at("pipe.json") + " " + at("pipe"), "is a pipe or a device");
  std::filesystem::remove(folder() / "tip.csv");
  std::filesystem::create_symlink("/dev/zero", folder() / "tip.csv");
  expectRefused("plan " + at("pipe.json") + " " + at("pipe"), "is a pipe or a device");
}

TEST_F(Sweeping, MergesNoFoldersOfOtherSweeps)
{
  plan("grid.json", "grid");
  ASSERT_EQ(sweep("run --jobs 2 " + at("grid")).code, 0);
  expectRefused("merge " + at("grid") + " " + at("nowhere") + " --out " + at("x.csv"),
    "nowhere/cases.csv: no sweep is planned there");
  write("other.json", R"({"palp_sweep": 1, "kind": "force", "fixed": {"depth": "2:2:1mm",
    "tip": "sphere:{radius}"}, "grid": {"poisson": [0.3], "radius": ["1mm"]}})");
  plan("other.json", "other");
  expectRefused("merge " + at("grid") + " " + at("other") + " --out " + at("x.csv"),
    "other: is of another sweep, 'other'");
  write("more.json", R"({"palp_sweep": 1, "kind": "force", "fixed": {"depth": "1:1:1mm",
    "tip": "sphere:{radius}"}, "grid": {"poisson": [0.3], "radius": ["1mm", "9mm"]}})");
  plan("more.json", "more");
  expectRefused("merge " + at("grid") + " " + at("more") + " --out " + at("x.csv"),
    "more: plans other cases, 2 beside 40");
  EXPECT_FALSE(std::filesystem::exists(folder() / "x.csv"));
}

TEST_F(Sweeping, WritesNoScriptOfAFolderThatSchedulersReadInAnotherWay)
{
  for (const char* strange : { "a{}", "100%a", "it's" })
  {
    for (const char* scheduler : { "--slurm", "--parallel" })
    {
      expectRefused(
        "plan " + std::string(scheduler) + " " + at("grid.json") + " \"" + at(strange) + "\"",
        "choose a folder without them");
    }
  }
}

TEST_F(Sweeping, RefusesBadInputInOneLine)
{
  write("unknown.json", R"({"palp_sweep": 1, "kind": "force", "grid": {"yuong": ["5kPa"]}})");
  expectRefused("plan " + at("unknown.json") + " " + at("x"),
    "unknown.json: 'yuong': palp force has no such option");
  write("circle.json",
    R"({"palp_sweep": 1, "kind": "force", "fixed": {"a": "{b}", "b": "{a}", "young": "{a}kPa"}})");
  expectRefused("plan " + at("circle.json") + " " + at("x"), "circle");
  write("units.json", R"({"palp_sweep": 1, "kind": "force", "grid": {"young": ["5kPa", "5Pa"]}})");
  expectRefused("plan " + at("units.json") + " " + at("x"), "different units");
  write("twice.json", R"({"palp_sweep": 1, "kind": "force", "fixed": {"tip": "sphere:{t_mm}mm",
    "thickness": "{t}"}, "grid": {"t": ["30mm", "40mm"], "t_mm": [3]}})");
  expectRefused("plan " + at("twice.json") + " " + at("x"), "rename one");
  write("value.json", R"({"palp_sweep": 1, "kind": "force", "grid": {"young": ["5kPa", "soft"]}})");
  expectRefused("plan " + at("value.json") + " " + at("x"), "case 1: --young");
  write("hard.json", R"({"palp_sweep": 1, "kind": "calibrate", "grid": {"poisson": [0.3, 0.5]}})");
  expectRefused("plan " + at("hard.json") + " " + at("x"), "case 1: ");
  write("where.json", R"({"palp_sweep": 1, "kind": "force", "grid": {"young": ["5kPa", "6kPa"]},
    "plots": [{"name": "p", "x": "depth_mm", "y": "force_N", "where": {"young_kPa": "5kPa"}}]})");
  expectRefused("plan " + at("where.json") + " " + at("x"), "written as '5'");
  // what only all values of a case together tell, before anything is computed
  write("nu.json", R"({"palp_sweep": 1, "kind": "force", "grid": {"poisson": [0.3, 0.7]}})");
  expectRefused("plan " + at("nu.json") + " " + at("x"), "nu.json: case 1: ");
  write("late.json", R"({"palp_sweep": 1, "kind": "force", "grid": {"relaxation": ["0.3:1s"]},
    "fixed": {"law": "corrected"}})");
  expectRefused("plan " + at("late.json") + " " + at("x"), "late.json: case 0: --relaxation");
  write("block.stl", "solid");
  write("nowhere.json", R"({"palp_sweep": 1, "kind": "run", "fixed": {"mesh": "block.stl"},
    "grid": {"young": ["5kPa", "6kPa"]}})");
  expectRefused("plan " + at("nowhere.json") + " " + at("x"), "nothing says where to press");
  write("absent.json", R"({"palp_sweep": 1, "kind": "run", "fixed": {"path": "absent.csv"}})");
  expectRefused("plan " + at("absent.json") + " " + at("x"), "absent.csv");
  EXPECT_FALSE(std::filesystem::exists(folder() / "x"));
  expectRefused("plan absent.json " + at("x"), "absent.json");
  expectRefused("plan nothing " + at("x"), "there are");
  expectRefused("run " + at("x"), "no sweep is planned there");
  plan("grid.json", "grid");
  expectRefused(
    "plan --slurm --pilot -1 " + at("grid.json") + " " + at("grid"), "--pilot: there is no case");
  expectRefused("run --case -1 " + at("grid"), "no case '-1'; give 0 to 39");
  expectRefused("run --case=1e3 " + at("grid"), "no case '1e3'");
  const Finished odd =
    test::runCommand("SLURM_ARRAY_TASK_ID=x " PALP_PROGRAM " sweep run " + at("grid"));
  EXPECT_EQ(odd.code, 2);
  EXPECT_NE(odd.err.find("SLURM_ARRAY_TASK_ID: there is no case 'x'"), std::string::npos);
  expectRefused("run --chunk 5 " + at("grid"), "--chunk: says how many");
  expectRefused("run --chunk 5 --case 8 " + at("grid"), "no chunk '8'; give 0 to 7");
  write("out.json", R"({"palp_sweep": 1, "kind": "run", "fixed": {"out": "x"}})");
  expectRefused("plan " + at("out.json") + " " + at("x"), "set by the sweep itself");
  const Finished none = sweep("merge --partial " + at("grid") + " --out " + at("x.csv"));
  EXPECT_EQ(none.code, 5);
  EXPECT_NE(none.err.find("40 of 40 cases without a result"), std::string::npos) << none.err;
  expectRefused("merge --plots " + at("grid") + " --out " + at("x.csv"), "--plots: this sweep");
  for (const char* bad : { "run --case 40 ", "run --shard 0/2 ", "run --shard 3/2 ",
         "run --shard a ", "run --case 1 --shard 1/2 ", "run --jobs 0 ", "run --jobs 99999 ",
         "merge --out x.txt ", "merge ", "status --x " })
  {
    expectRefused(bad + at("grid"), "");
  }
}

} // namespace
} // namespace palp
