#include "app/commands.h"
#include "app/stability_map.h"
#include "app/stability_study.h"
#include "haptics/error.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <vector>

namespace palp
{
namespace
{

struct StabilityOptions
{
  std::filesystem::path out;
  bool quick = false;
};

std::ofstream openFile(const std::filesystem::path& file)
{
  std::ofstream out(file);
  if (!out)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": cannot be written; give --out a directory where you may write");
  }
  return out;
}

void studyStability(const StabilityOptions& options)
{
  std::error_code failed; // opening the files says what is wrong
  std::filesystem::create_directories(options.out, failed);
  std::ofstream table = openFile(options.out / "stability.csv");
  std::ofstream map = openFile(options.out / "stability.svg");

  const std::vector<JudgedCase> cases = judgeAll(options.quick);
  table << report::csv(stabilityTable(cases));
  drawStabilityMap(map, cases);
  std::cout << stabilitySummary(cases);
}

} // namespace

void addStabilityCommand(CLI::App& app)
{
  auto options = std::make_shared<StabilityOptions>();
  CLI::App* command = app.add_subcommand(
    "stability", "Simulate hand, device and tissue in closed loop, from soft to rigid");
  command->add_option("--out", options->out, "Directory for stability.csv and stability.svg")
    ->required();
  command->add_flag("--quick", options->quick, "A tenth of the cases: seconds, not minutes");
  command->footer(
    "unstable: the loop gave energy to the hand (energy_uJ below -1), or the hand did not come\n"
    "to rest (late speed above a tenth of the early one), or it hummed at an encoder of 48 um\n"
    "(hum_m_per_s above 0.025). refused: no force was given, or a fault ended it. limited_by\n"
    "names the stages of the chain that acted.\n"
    "Example:\n"
    "  palp stability --out out --quick");
  command->callback([options] { studyStability(*options); });
}

} // namespace palp
