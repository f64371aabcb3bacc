#include "tests/app/sweep/sweep_rig.h"

#include <chrono>
#include <fcntl.h>
#include <seccomp.h>
#include <sys/file.h>

// what other machines and their disks are like

namespace palp
{
namespace
{

using test::Finished;
using test::sweep;
using test::Sweeping;

constexpr const char* kNewMachine = "unshare -rpf --mount-proc ";

bool mayUnshare()
{
  return test::runCommand(std::string(kNewMachine) + "mount -t tmpfs none /mnt").code == 0;
}

// processes of another numbering count as those of another machine; its clock is an hour off, that
// of the disk is not
TEST_F(Sweeping, TwoMachinesWhoseClocksDifferDoEachCaseOnce)
{
  if (!mayUnshare())
  {
    GTEST_SKIP() << "no namespace may be made here";
  }
  ASSERT_EQ(test::runCommand("command -v faketime").code, 0) << "app/setup.sh installs it";
  plan("grid.json", "both");
  countStarts("sleep 0.05"); // for the other one to come
  const std::string here = counting() + " run --jobs 2 " + at("both");
  for (const char* clock : { "+1h", "-1h" })
  {
    std::filesystem::remove_all(folder() / "both/results");
    std::filesystem::remove(folder() / "starts");
    const Finished both = test::runCommand(std::string(kNewMachine) +
      "env NO_FAKE_STAT=1 FAKE_UTIME=1 FAKETIME_DONT_FAKE_MONOTONIC=1 faketime -f " + clock +
      " env " + here + " & " + here + "; first=$?; wait $! && [ $first = 0 ]");
    EXPECT_EQ(both.code, 0) << both.err;
    EXPECT_EQ(starts(), kCases) << both.err;
    EXPECT_EQ(results("both").size(), std::size_t{ kCases });
  }
}

// a network disk without its lock service
TEST_F(Sweeping, NeedsNoLocks)
{
  write("tables.json", R"({"palp_sweep": 1, "kind": "calibrate", "fixed":
    {"depth": "1:1:1mm", "element-size": "1mm"}, "grid": {"young": ["5kPa", "20kPa"]}})");
  plan("tables.json", "locks");
  ASSERT_EQ(sweep("run " + at("locks")).code, 0);
  const std::string none = at("none");
  const pid_t child = fork();
  if (child == 0)
  {
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
    seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOLCK), SCMP_SYS(flock), 0);
    for (const int lock : { F_SETLK, F_SETLKW, F_OFD_SETLK, F_OFD_SETLKW })
    {
      seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOLCK), SCMP_SYS(fcntl), 1,
        SCMP_A1(SCMP_CMP_EQ, static_cast<scmp_datum_t>(lock)));
    }
    const bool loaded = seccomp_load(filter) == 0 && flock(STDIN_FILENO, LOCK_SH) != 0;
    const Finished all = test::runCommand(PALP_PROGRAM " sweep plan " + at("tables.json") + " " +
      none + " && " PALP_PROGRAM " sweep run --jobs 2 " + none);
    _exit(loaded ? all.code : 99);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(merged("none"), merged("locks"));
}

// a runner that was stopped for long and goes on, as with the node it is on
TEST_F(Sweeping, WaitsForNoRunnerThatWasStopped)
{
  plan("grid.json", "grid");
  countStarts("until [ -e " + at("go") + " ]; do sleep 0.02; done");
  const std::string one = " run --case 3 " + at("grid");
  const auto owner = [&]() -> std::filesystem::path
  {
    std::error_code none;
    const std::filesystem::directory_iterator claims(folder() / "grid/running", none);
    return claims == end(claims) ? "" : claims->path() / "owner";
  };
  const pid_t first = fork();
  if (first == 0)
  {
    const Finished run = counted(one);
    _exit(run.code);
  }
  std::string machine;
  pid_t process = 0;
  while (starts() == 0 || !(std::ifstream(owner()) >> machine >> machine >> process))
  {
    usleep(20'000);
  }
  kill(process, SIGSTOP);
  std::filesystem::last_write_time(
    owner(), std::filesystem::file_time_type::clock::now() - std::chrono::minutes(10));
  write("go", "");
  const Finished second = counted(one);
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_NE(second.err.find("1 case computed"), std::string::npos) << second.err;
  kill(process, SIGCONT);
  int status = -1;
  waitpid(first, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(results("grid").size(), 1U);
  EXPECT_NE(sweep("status " + at("grid")).out.find("1 of 40 cases done, 0 running, 0 failed"),
    std::string::npos);
}

TEST_F(Sweeping, OnAFullDiskLosesNothing)
{
  if (!mayUnshare())
  {
    GTEST_SKIP() << "nothing may be mounted here";
  }
  plan("grid.json", "serial");
  ASSERT_EQ(sweep("run --jobs 2 " + at("serial")).code, 0);
  const std::string disk = at("disk");
  std::filesystem::create_directory(disk);
  const std::string palp = PALP_PROGRAM " sweep ";
  write("full.sh",
    "cd " + disk + "\nmount -t tmpfs -o size=4m none . && cd . || exit 77\ncd " + disk + "\n" +
      palp + "plan " + at("grid.json") + " s && " + palp +
      "run --shard 1/2 s || exit 1\n"
      "head -c 8m /dev/zero > filler\n" +
      palp + "run s; echo $?\n" + palp + "plan " + at("grid.json") + " s; echo $?\n" + palp +
      "merge --partial s --out all.csv; echo $?\n" + palp + "status s\nrm filler\n" + palp +
      "run s && " + palp + "merge s --out " + at("disk.csv") + "\n");
  const Finished full = test::runCommand("unshare -rm sh " + at("full.sh"));
  EXPECT_EQ(full.code, 0) << full.err;
  EXPECT_TRUE(full.out.starts_with("2\n2\n2\ngrid: 20 of 40 cases done")) << full.out << full.err;
  std::size_t sentences = 0;
  for (std::size_t at = full.err.find("No space left"); at != full.err.npos;
       at = full.err.find("No space left", at + 1))
  {
    ++sentences;
  }
  EXPECT_EQ(sentences, 3U + 1U) << full.err; // of palp, and of head
  EXPECT_NE(full.err.find("20 cases computed, 20 finished"), std::string::npos) << full.err;
  EXPECT_EQ(test::readAll(folder() / "disk.csv"), merged("serial"));
}

// each case would be computed for nothing
TEST_F(Sweeping, OnADiskThatIsTooSmallForACaseEndsAtTheFirst)
{
  if (!mayUnshare())
  {
    GTEST_SKIP() << "nothing may be mounted here";
  }
  write("run.json", R"({"palp_sweep": 1, "kind": "run", "fixed": {"at": "-48.5,38.4,39.5",
    "depth": "3mm"}, "grid": {"young": ["1kPa", "2kPa", "3kPa", "4kPa", "5kPa", "6kPa"]}})");
  const std::string disk = at("disk");
  std::filesystem::create_directory(disk);
  const std::string palp = PALP_PROGRAM " sweep ";
  write("small.sh",
    "mount -t tmpfs -o size=160k none " + disk + " || exit 77\ncd " + disk + "\n" + palp + "plan " +
      at("run.json") + " s && " + palp + "run s; echo $?\n" + palp + "status s\n");
  const Finished small = test::runCommand("unshare -rm sh " + at("small.sh"));
  EXPECT_TRUE(small.out.ends_with("2\nrun: 0 of 6 cases done, 0 running, 0 failed, 6 waiting\n"))
    << small.out << small.err;
  const std::size_t first = small.err.find("No space left");
  ASSERT_NE(first, small.err.npos) << small.err;
  EXPECT_EQ(small.err.find("No space left", first + 1), small.err.npos) << small.err;
  EXPECT_NE(small.err.find("make room and run again"), small.err.npos) << small.err;
}

// as over a line that is cut: the shell ends what has no nohup
TEST_F(Sweeping, GoesOnUnderNohup)
{
  plan("grid.json", "grid");
  countStarts("sleep 0.05");
  const Finished done = test::runCommand("trap '' HUP; " + counting() + " run " + at("grid") +
    " & running=$!; until [ -s " + at("starts") + " ]; do sleep 0.02; done; kill -HUP $running; " +
    "wait $running");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(results("grid").size(), std::size_t{ kCases });
}

// scancel and timeout ask runner and cases alike; no case failed by that
TEST_F(Sweeping, AGroupThatIsAskedToEndLeavesNoFailure)
{
  plan("grid.json", "grid");
  countStarts("sleep 0.2");
  for (int i = 0; i < 5; ++i)
  {
    const std::string begun = std::to_string(starts() + 1 + i);
    const Finished asked = test::runCommand("setsid env " + counting() + " run --jobs 2 " +
      at("grid") + " & running=$!; until [ \"$(grep -c x " + at("starts") + ")\" -ge " + begun +
      " ]; do sleep 0.01; done; /bin/kill -TERM -- -$running; wait $running");
    EXPECT_EQ(asked.code, 5) << asked.err;
    EXPECT_NE(asked.err.find("interrupted"), std::string::npos) << asked.err;
    EXPECT_FALSE(std::filesystem::exists(folder() / "grid/failed")) << asked.err;
  }
}

} // namespace
} // namespace palp
