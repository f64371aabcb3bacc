#include "app/bench/bench.h"
#include "app/bench/bench_sweep.h"
#include "app/commands/commands.h"
#include "app/headless/renderer.h"
#include "app/input/quantity.h"
#include "app/program/exec_program.h"
#include "app/program/machine.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <memory>
#include <unistd.h>

namespace palp
{
namespace
{

constexpr Bounds kServoTimes{ 1.0, 86400.0, "1s to 86400s" };
constexpr Bounds kBusTimes{ 1e-5, 0.01, "0.01ms to 10ms" };
constexpr Bounds kSpinTimes{ 0.0, 2e-4, "0ms to 0.2ms" };
constexpr Bounds kRates{ 1000.0, 4000.0, "1kHz to 4kHz" };

struct BenchOptions
{
  bool json = false;
  bool accuracy = false;
  bool baselines = false;
  bool frames = false;
  bool quick = false;
  std::string servo;
  std::string bus;
  std::string rate;
  std::string spin;
  int processor = -1;
  std::filesystem::path sweep;
  std::size_t cases = BenchedSweep().planned;
  std::filesystem::path gate;
  double slack = 1.5;
  std::size_t most = 1'000'000;
};

struct Bench
{
  double sweep = 0.0; // S [us]
  std::vector<BenchRow> rows;
};

// S before, between and after, for other work on the machine comes and goes
Bench measure(const BenchOptions& options, const Renderer* pictures)
{
  std::vector<double> sweeps{ benchSweep() };
  Bench bench;
  bench.rows = options.baselines ? benchBaselines()
    : options.frames             ? pictures->benchFrames(options.most, options.quick ? 20 : 200)
                                 : benchServo(options.most, options.quick ? 400 : 4000);
  sweeps.push_back(benchSweep());
  if (!options.baselines && !options.frames)
  {
    const std::vector<BenchRow> update = benchUpdate(options.most);
    bench.rows.insert(bench.rows.end(), update.begin(), update.end());
  }
  sweeps.push_back(benchSweep());
  std::sort(sweeps.begin(), sweeps.end());
  bench.sweep = sweeps[1];
  return bench;
}

nlohmann::ordered_json toJson(const Bench& bench)
{
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const BenchRow& row : bench.rows)
  {
    nlohmann::ordered_json entry{ { "work", row.work }, { "vertices", row.vertices },
      { "case", row.mode }, { "median_us", row.median }, { "mean_us", row.mean },
      { "sd_us", row.deviation }, { "p99_us", row.p99 }, { "per_S", row.median / bench.sweep } };
    if (!row.variant.empty())
    {
      entry["variant"] = row.variant;
    }
    rows.push_back(entry);
  }
  return { { "machine", processorName() }, { "S_us", bench.sweep }, { "rows", rows } };
}

void printTable(const Bench& bench)
{
  std::cout
    << processorName() << ", S = " << std::fixed << std::setprecision(2) << bench.sweep << " us\n\n"
    << "work         vertices  case     median us    mean us      sd us     p99 us       x S\n";
  for (const BenchRow& row : bench.rows)
  {
    std::cout << std::left << std::setw(12) << row.work << std::right << std::setw(9)
              << row.vertices << "  " << std::left << std::setw(7) << row.mode << std::right
              << std::setprecision(3);
    for (const double value :
      { row.median, row.mean, row.deviation, row.p99, row.median / bench.sweep })
    {
      std::cout << std::setw(11) << value;
    }
    std::cout << (row.variant.empty() ? "" : "  ") << row.variant << '\n';
  }
  std::cout << std::defaultfloat;
}

nlohmann::json readGate(const std::filesystem::path& file)
{
  nlohmann::json recorded =
    nlohmann::json::parse(readText(file, "the output of palp bench --json"), nullptr, false);
  if (!recorded.is_object() || !recorded.contains("rows"))
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": not the output of palp bench --json; record one with it");
  }
  return recorded;
}

// rows that take more of S than recorded, beyond the slack
void checkGate(const Bench& bench, const nlohmann::json& recorded, double slack)
{
  std::string slower;
  std::size_t compared = 0;
  for (const nlohmann::json& old : recorded["rows"])
  {
    for (const BenchRow& row : bench.rows)
    {
      if (old.value("work", "") != row.work || old.value("case", "") != row.mode ||
        old.value("variant", "") != row.variant ||
        old.value("vertices", std::size_t{ 0 }) != row.vertices)
      {
        continue;
      }
      ++compared;
      const double now = row.median / bench.sweep;
      const double before = old.value("per_S", 0.0);
      if (now > slack * before)
      {
        slower += " " + row.work + " " + std::to_string(row.vertices) + " " + row.mode + " (" +
          std::to_string(now) + " S, recorded " + std::to_string(before) + ")";
      }
    }
  }
  if (compared == 0)
  {
    throw Error(ErrorCode::BadFile, "--gate: no row in common with this run; record a new one");
  }
  if (!slower.empty())
  {
    throw Error(ErrorCode::BadValue, "--gate: slower than recorded:" + slower + "; find out why");
  }
}

ServoBench servoBench(const BenchOptions& options)
{
  using Seconds = std::chrono::duration<double>;
  const auto time = [](const std::string& text, const Bounds& bounds, const char* name)
  { return Seconds(text.empty() ? 0.0 : parseWithin(text, Quantity::Time, bounds, name)); };
  ServoBench bench{ .duration = time(options.servo, kServoTimes, "--servo"),
    .bus = time(options.bus, kBusTimes, "--bus"),
    .spin = std::chrono::duration_cast<std::chrono::nanoseconds>(
      time(options.spin, kSpinTimes, "--spin")),
    .processor = options.processor };
  if (!options.rate.empty())
  {
    bench.period = Seconds(1.0 / parseWithin(options.rate, Quantity::Frequency, kRates, "--rate"));
  }
  return bench;
}

void runBench(const BenchOptions& options, const Renderer* pictures)
{
  if (!(options.slack >= 1.0)) // CLI11's range lets nan pass
  {
    throw Error(ErrorCode::BadValue, "--slack: not a number; give 1 to 100");
  }
  if (options.frames && !pictures)
  {
    execProgram("palp-draw");
  }
  if (options.accuracy)
  {
    reportAccuracy(std::cout);
    return;
  }
  if (!options.servo.empty())
  {
    reportServo(std::cout, servoBench(options), options.json);
    return;
  }
  if (!options.sweep.empty())
  {
    reportSweep(std::cout, options.sweep,
      options.quick
        ? BenchedSweep{ .planned = options.cases, .computed = 4, .timed = 2, .rounds = 1 }
        : BenchedSweep{ .planned = options.cases });
    return;
  }
  const nlohmann::json recorded = options.gate.empty() ? nullptr : readGate(options.gate);
  const Bench bench = measure(options, pictures);
  if (options.json)
  {
    std::cout << toJson(bench).dump(1) << '\n';
  }
  else
  {
    printTable(bench);
  }
  if (!recorded.is_null())
  {
    checkGate(bench, recorded, options.slack);
  }
}

} // namespace

void addBenchCommand(CLI::App& app, const Renderer* pictures)
{
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand("bench", "Measure speed and accuracy on this machine");
  command->add_flag("--json", options->json, "Print JSON and nothing else");
  command->add_option("--gate", options->gate,
    "JSON of an earlier run: fail where a figure takes more of S than recorded there");
  command->add_option("--slack", options->slack, "How many times more --gate lets pass")
    ->check(CLI::Range(1.0, 100.0))
    ->capture_default_str();
  command->add_option("--most", options->most, "Vertices of the largest surface")
    ->check(CLI::Range(0, 10'000'000))
    ->capture_default_str();
  command->add_flag("--quick", options->quick, "A tenth of the repetitions");
  CLI::Option* baselines = command->add_flag("--baselines", options->baselines,
    "Instead: one step of springs and of finite elements beside ours, as Fig. 12");
  CLI::Option* frames = command->add_flag("--frames", options->frames,
    "Instead: what a moved dent costs a picture beyond drawing the same scene again");
  CLI::Option* accuracy = command->add_flag("--accuracy", options->accuracy,
    "Instead: force error from the mesh, and smoothness, for each rule of contact");
  CLI::Option* servo = command->add_option("--servo", options->servo,
    "Instead: how well a servo thread keeps its rate for so long, like 60s");
  command
    ->add_option("--bus", options->bus,
      "Of --servo: by a board whose every exchange takes so long, like 0.5ms; how late its forces "
      "are")
    ->needs(servo);
  command->add_option("--rate", options->rate, "Of --servo: 1kHz to 4kHz")->needs(servo);
  command->add_option("--spin", options->spin, "Of --servo: awake before each tick, like 0.05ms")
    ->needs(servo);
  command->add_option("--processor", options->processor, "Of --servo: to stay on, from 0")
    ->check(CLI::Range(0, static_cast<int>(sysconf(_SC_NPROCESSORS_CONF)) - 1))
    ->needs(servo);
  CLI::Option* sweep = command->add_option("--sweep", options->sweep,
    "Instead: what a sweep costs on the disk of this folder, which is made and removed");
  command->add_option("--cases", options->cases, "Of that sweep; 16 kB of disk each")
    ->check(CLI::Range(1, 10'000'000))
    ->capture_default_str();
  const std::array instead{ baselines, frames, accuracy, servo, sweep };
  for (CLI::Option* one : instead)
  {
    std::ranges::for_each(
      instead, [one](CLI::Option* other) { other != one ? void(one->excludes(other)) : void(); });
  }
  command->footer("S is a scalar sweep over 10,000 points in the same run, by which machines "
                  "compare; x S is the median as a multiple of it.\n"
                  "Examples:\n"
                  "  palp bench\n"
                  "  palp bench --json > before.json && palp bench --gate before.json\n"
                  "  palp bench --servo 60s\n"
                  "  palp bench --servo 20s --bus 0.5ms --json\n"
                  "  palp bench --sweep /scratch/new --cases 100000");
  command->callback([options, pictures] { runBench(*options, pictures); });
}

} // namespace palp
