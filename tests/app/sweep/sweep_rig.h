#pragma once

#include "tests/support/process.h"

#include <algorithm>
#include <csignal>
#include <gtest/gtest.h>
#include <map>

namespace palp::test
{

/// What palp sweep does.
inline Finished sweep(const std::string& arguments)
{
  return runCommand(PALP_PROGRAM " sweep " + arguments);
}

/// A sweep of 40 forces in grid.json, and folders to compute it in.
class Sweeping : public testing::Test
{
protected:
  using Results = std::map<std::string, std::string>; // record of each finished case by its name
  static constexpr int kCases = 40;

  Sweeping()
  {
    write("grid.json", R"({"palp_sweep": 1, "kind": "force", "fixed": {"depth": "1:1:1mm",
      "tip": "sphere:{radius}"}, "grid": {"poisson": [0.3, 0.35, 0.4, 0.45, 0.5],
      "radius": ["1mm", "2mm", "3mm", "4mm", "5mm", "6mm", "7mm", "8mm"]}})");
    countStarts("");
  }

  [[nodiscard]] const std::filesystem::path& folder() const
  {
    return folder_.path();
  }
  [[nodiscard]] std::string at(const std::string& name) const
  {
    return (folder() / name).string();
  }
  void write(const std::string& name, const std::string& text) const
  {
    std::filesystem::create_directories((folder() / name).parent_path());
    std::ofstream(folder() / name) << text;
  }

  /// Stands before the program and counts the starts of cases, before each of which it runs a
  /// line of shell.
  void countStarts(const std::string& before) const
  {
    write("bin/palp",
      "#!/bin/sh\nif [ $1 = force ]; then echo x >> " + at("starts") + "; " + before +
        "\nfi\nexec " PALP_PROGRAM " \"$@\"\n");
    std::filesystem::permissions(folder() / "bin/palp", std::filesystem::perms::owner_all);
  }

  void plan(
    const std::string& file, const std::string& where, const std::string& options = "") const
  {
    const Finished planned = sweep("plan " + at(file) + " " + at(where) + " " + options);
    ASSERT_EQ(planned.code, 0) << planned.err;
  }

  [[nodiscard]] std::string counting() const
  {
    return "PALP_DATA=" PALP_SHARE " PALP_PREFIX=" + folder().string() + " " PALP_PROGRAM " sweep";
  }
  [[nodiscard]] Finished counted(const std::string& arguments) const
  {
    return runCommand(counting() + " " + arguments);
  }
  [[nodiscard]] int starts() const
  {
    const std::string text = readAll(folder() / "starts");
    return static_cast<int>(std::count(text.begin(), text.end(), 'x'));
  }

  [[nodiscard]] std::string merged(const std::string& where) const
  {
    const Finished done = sweep("merge " + at(where) + " --overwrite --out " + at("merged.csv"));
    EXPECT_EQ(done.code, 0) << done.err;
    return readAll(folder() / "merged.csv");
  }

  [[nodiscard]] Results results(const std::string& where) const
  {
    Results found;
    std::error_code missing;
    for (const auto& part :
      std::filesystem::directory_iterator(folder() / where / "results", missing))
    {
      for (const auto& one : std::filesystem::directory_iterator(part.path()))
      {
        found[one.path().filename()] = readAll(one.path() / "case.json");
      }
    }
    return found;
  }

  /// Kills a process that has a case, or what started it.
  void killWorker(const std::string& where, bool itsMaster) const
  {
    std::error_code missing;
    for (const auto& claim :
      std::filesystem::directory_iterator(folder() / where / "running", missing))
    {
      std::istringstream owner(readAll(claim.path() / "owner"));
      std::string machine;
      int process = 0;
      if (std::getline(owner, machine) && owner >> process)
      {
        const std::string stat = readAll("/proc/" + std::to_string(process) + "/stat");
        int parent = 0;
        char state = ' ';
        std::istringstream(stat.substr(std::min(stat.size(), stat.rfind(')') + 1))) >> state >>
          parent;
        for (const int victim : { itsMaster ? parent : 0, process })
        {
          const std::string words = readAll("/proc/" + std::to_string(victim) + "/cmdline");
          if (victim > 1 && words.find(at(where)) != std::string::npos) // one of ours
          {
            kill(victim, SIGKILL);
            return;
          }
        }
      }
    }
  }

  static void expectRefused(const std::string& arguments, const std::string& words)
  {
    const Finished refused = sweep(arguments);
    EXPECT_EQ(refused.code, 2) << arguments << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_NE(refused.err.find(words), std::string::npos) << refused.err;
  }

private:
  TemporaryFolder folder_;
};

} // namespace palp::test
