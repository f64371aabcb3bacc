#include "app/commands.h"
#include "app/csv.h"
#include "app/stability_map.h"
#include "app/tip_spec.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <thread>
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

// each case depends on nothing but itself, so their order of work does not matter
std::vector<JudgedCase> judgeAll(bool quick)
{
  std::vector<JudgedCase> cases;
  for (StabilityCase& what : stabilityCases(quick))
  {
    cases.push_back({ .what = std::move(what), .chain = {}, .bare = {} });
  }
  std::atomic<std::size_t> next = 0;
  const auto work = [&]
  {
    for (std::size_t i = next++; i < cases.size(); i = next++)
    {
      cases[i].chain = judge(cases[i].what, true);
      cases[i].bare = judge(cases[i].what, false);
    }
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
  {
    others.emplace_back(work);
  }
  work();
  others.clear();
  return cases;
}

void writeRow(std::ostream& out, const StabilityCase& what, const StabilityRow& row, bool chain)
{
  const double infinite = std::numeric_limits<double>::infinity();
  out << what.name << ',' << shortest(what.material ? what.material->youngModulus : infinite) << ','
      << (what.material ? shortest(what.material->poissonRatio) : "") << ','
      << describeTip(what.tip) << ',' << shortest(units::toMilliseconds(what.loop.period)) << ','
      << (chain ? "on" : "off") << ',' << nameOf(row.outcome) << ',' << row.limitedBy << ',';
  writeCsvRow(out, std::array{ row.peakForce, row.hum, units::toMicrojoules(row.energy) });
}

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

std::ptrdiff_t count(
  const std::vector<JudgedCase>& cases, StabilityRow JudgedCase::*side, StabilityOutcome outcome)
{
  return std::ranges::count_if(
    cases, [&](const JudgedCase& one) { return (one.*side).outcome == outcome; });
}

// the sentence that the client asked for, with the rows behind each exception
void report(const std::vector<JudgedCase>& cases)
{
  using enum StabilityOutcome;
  std::cout << "Of " << cases.size() << " situations from 1 kPa to a rigid wall, "
            << count(cases, &JudgedCase::bare, Unstable)
            << " are unstable when the law goes to the motors as it is. Through the safety chain "
            << count(cases, &JudgedCase::chain, Unstable)
            << " are: " << count(cases, &JudgedCase::chain, Stable) << " are felt exactly, "
            << count(cases, &JudgedCase::chain, Limited) << " stably within a limit, "
            << count(cases, &JudgedCase::chain, Refused) << " are refused.\n";
  double worst = 0.0;
  std::vector<std::string> named;
  for (const JudgedCase& one : cases)
  {
    worst = std::min(worst, one.chain.energy);
    if (one.chain.outcome >= Refused)
    {
      const std::string name = "  " + std::string(nameOf(one.chain.outcome)) + ": " + one.what.name;
      if (std::ranges::find(named, name) == named.end())
      {
        named.push_back(name);
      }
    }
  }
  for (const std::string& name : named)
  {
    std::cout << name << '\n';
  }
  std::cout << "Most energy that the chain gave to a hand: "
            << shortest(units::toMicrojoules(std::max(0.0, -worst))) << " uJ.\n";
}

void studyStability(const StabilityOptions& options)
{
  std::error_code failed; // opening the files says what is wrong
  std::filesystem::create_directories(options.out, failed);
  std::ofstream table = openFile(options.out / "stability.csv");
  std::ofstream map = openFile(options.out / "stability.svg");

  const std::vector<JudgedCase> cases = judgeAll(options.quick);
  table << "case,young_Pa,poisson,tool,period_ms,chain,outcome,limited_by,peak_force_N,"
           "hum_m_per_s,energy_uJ\n";
  for (const JudgedCase& one : cases)
  {
    writeRow(table, one.what, one.chain, true);
    writeRow(table, one.what, one.bare, false);
  }
  drawStabilityMap(map, cases);
  report(cases);
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
