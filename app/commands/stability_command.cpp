#include "app/commands/commands.h"
#include "app/program/output.h"
#include "app/program/progress_line.h"
#include "app/report/stability_map.h"
#include "app/report/stability_study.h"
#include "haptics/files/replace_file.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

namespace palp
{
namespace
{

struct StabilityOptions
{
  std::filesystem::path out;
  bool quick = false;
  bool overwrite = false;
};

void studyStability(const StabilityOptions& options)
{
  Outputs outputs;
  OutputFolder& output =
    outputs.open(options.out, { "stability.csv", "stability.svg" }, options.overwrite);
  const std::vector<JudgedCase> cases = [&]
  {
    ProgressLine progress("closed loops");
    return judgeAll(options.quick, {}, [&](double part) { progress(part); });
  }();
  std::ostringstream map;
  drawStabilityMap(map, cases);
  replaceFile(output.stage() / "stability.csv", figures::csv(stabilityTable(cases)));
  replaceFile(output.stage() / "stability.svg", map.str());
  output.publish();
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
  addOverwrite(*command, options->overwrite);
  command->add_flag("--quick", options->quick, "A tenth of the cases: seconds, not minutes");
  command->footer(
    "unstable, where a row has no mass_kg: the loop gave energy to the hand (energy_uJ below -1),\n"
    "or the hand did not come to rest (late speed above a tenth of the early one), or it went on\n"
    "in a limit cycle at an encoder of 48 um (limit_cycle_speed_m_per_s above 0.025). Of an arm\n"
    "(mass_kg): it went on above 0.025 m/s, dying at less than a fifth of the rate of its own\n"
    "damping and the hand's, or it gave more than 5 mJ, or 50 mJ where less delay is told than it\n"
    "has. refused: no force was given, or a fault ended it. limited_by names the stages of the\n"
    "chain that acted.\n"
    "Example:\n"
    "  palp stability --out out --quick");
  command->callback([options] { studyStability(*options); });
}

} // namespace palp
