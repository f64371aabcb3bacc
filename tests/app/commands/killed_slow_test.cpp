#include "tests/support/process.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <spawn.h>
#include <thread>

// every command that writes, killed at 1,000 random moments each

namespace palp
{
namespace
{

using Clock = std::chrono::steady_clock;
using Files = std::map<std::string, std::string>; // text by name, without what is hidden

Files filesIn(const std::filesystem::path& folder)
{
  Files files;
  std::error_code missing;
  for (auto at = std::filesystem::recursive_directory_iterator(folder, missing);
       at != std::filesystem::recursive_directory_iterator(); ++at)
  {
    const bool hidden = at->path().filename().string().starts_with(".");
    if (at->is_directory() && hidden)
    {
      at.disable_recursion_pending();
    }
    else if (!at->is_directory())
    {
      files[std::filesystem::relative(at->path(), folder).string()] = test::readAll(at->path());
    }
  }
  return files;
}

void restore(const std::filesystem::path& folder, const Files& files)
{
  std::filesystem::remove_all(folder);
  for (const auto& [name, text] : files)
  {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
  }
}

// starts a program in a group of its own and kills it with its children after a while
void killAfter(const std::string& command, std::chrono::duration<double> wait)
{
  std::string exec = "exec " + command + " >/dev/null 2>&1";
  std::string shell = "/bin/sh";
  std::string option = "-c";
  char* arguments[] = { shell.data(), option.data(), exec.data(), nullptr };
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  ASSERT_EQ(posix_spawn(&child, shell.c_str(), nullptr, &attributes, arguments, environ), 0);
  posix_spawnattr_destroy(&attributes);
  std::this_thread::sleep_for(wait);
  kill(-child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
}

constexpr int kKills = 1000;
constexpr const char* kBefore = "\nof the run before"; // ends each file of that

class Killed : public testing::Test
{
protected:
  /// @param isWhole  of the files: those before and those of a run that nobody killed are
  void killOften(
    const std::string& command,
    const std::function<bool(const Files&)>& isWhole = [](const Files&) { return false; })
  {
    const std::string full = PALP_PROGRAM " " + command + " --overwrite --out " + out_.string();
    const auto start = Clock::now();
    ASSERT_EQ(test::runCommand(full).code, 0);
    const std::chrono::duration<double> duration = Clock::now() - start;
    const Files fresh = filesIn(out_);
    Files old = fresh;
    for (auto& [name, text] : old)
    {
      text += kBefore;
    }
    std::mt19937 random(1); // NOLINT: the same moments each time
    std::uniform_real_distribution<double> share(0.0, 1.2);
    restore(out_, old);
    for (int i = 0; i < kKills; ++i)
    {
      killAfter(full, share(random) * duration);
      const Files now = filesIn(out_);
      ASSERT_TRUE(now == old || now == fresh || isWhole(now)) << "after kill " << i;
      if (now != old)
      {
        restore(out_, old);
      }
    }
    ASSERT_EQ(test::runCommand(full).code, 0);
    EXPECT_EQ(filesIn(out_), fresh);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
  }

  test::TemporaryFolder folder_;
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

TEST_F(Killed, Scene)
{
  killOften("scene block_force");
}

TEST_F(Killed, Stability)
{
  killOften("stability --quick");
}

TEST_F(Killed, Experiment)
{
  killOften("experiment inclination profiles --quick");
}

// the depths so far, all of the new case
TEST_F(Killed, Calibration)
{
  const auto isNew = [](const Files& files)
  {
    return std::ranges::none_of(
             files, [](const auto& file) { return file.second.ends_with(kBefore); }) &&
      files.contains("table.csv") && files.contains("profiles.csv") && files.contains("fit.json");
  };
  killOften("calibrate --element-size 2mm --depth 0.5:3:0.5mm", isNew);
}

} // namespace
} // namespace palp
