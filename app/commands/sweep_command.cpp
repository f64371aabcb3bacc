#include "app/commands/commands.h"
#include "app/commands/sweep_case.h"
#include "app/headless/renderer.h"
#include "app/program/exec_program.h"
#include "app/sweep/case_folders.h"
#include "app/sweep/case_numbers.h"
#include "app/sweep/cases/input_watch.h"
#include "app/sweep/cases/merge.h"
#include "app/sweep/cases/pilot.h"
#include "app/sweep/cases/runner.h"
#include "app/sweep/cases/schedulers.h"
#include "app/sweep/cases/status.h"
#include "app/sweep/cases/sweep_figures.h"
#include "app/sweep/plan.h"
#include "app/sweep/sweep_file.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/output_folder.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>

namespace palp
{
namespace
{

struct SweepOptions
{
  std::string file;
  std::filesystem::path folder;
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;
  std::string number; // as given
  std::string shard;
  std::optional<std::size_t> chunk;
  std::string pilot; // as given
  std::size_t tasks = kMostTasks;
  unsigned jobs = 1;
  MergeOptions merge;
  bool checks = false;
  bool slurm = false;
  bool parallel = false;
  bool plots = false;
};

// of --case, or of the task that Slurm runs; chunks: how many there are, of one thing or several
std::optional<std::size_t> taskOf(const std::string& given, std::size_t chunks, const char* thing)
{
  const char* task = std::getenv("SLURM_ARRAY_TASK_ID"); // NOLINT(concurrency-mt-unsafe)
  if (given.empty() && task == nullptr)
  {
    return std::nullopt;
  }
  return given.empty() ? numberBelow(task, chunks, "SLURM_ARRAY_TASK_ID", thing)
                       : numberBelow(given, chunks, "--case", thing);
}

std::vector<std::size_t> numbersOf(const SweepOptions& options, const Manifest& manifest)
{
  const std::size_t count = manifest.head().count;
  if (!options.shard.empty())
  {
    return shardOf(options.shard, count);
  }
  const std::size_t chunk = options.chunk.value_or(1);
  if (const auto task =
        taskOf(options.number, (count + chunk - 1) / chunk, options.chunk ? "chunk" : "case"))
  {
    return manifest.numbers(*task * chunk, chunk);
  }
  if (options.chunk)
  {
    throw Error(ErrorCode::BadValue,
      "--chunk: says how many cases --case or SLURM_ARRAY_TASK_ID stands for; give one of them, or "
      "leave it out for all cases");
  }
  return manifest.numbers();
}

void run(Manifest& manifest, const std::vector<std::size_t>& numbers, unsigned jobs, bool checks)
{
  const RunOutcome outcome = runCases(manifest, numbers, jobs, checks);
  if (!outcome.warned.empty())
  {
    const PlannedCase first = manifest.at(outcome.warned.front());
    std::cerr << "palp: warning: " << counted(outcome.warned.size(), "case")
              << " computed with a warning, as case " << first.number << ", see "
              << (CaseFolders{ manifest.folder() }.result(first.name) / kLogFile).string() << '\n';
  }
  refuseFailed(outcome, manifest.folder());
  std::cerr << "palp: " << counted(outcome.computed, "case") << " computed, " << outcome.before
            << " finished before\n";
}

// the first, the middle and the last case, one of which mostly is long
std::vector<std::size_t> pilotsOf(const std::string& given, std::size_t count)
{
  if (!given.empty())
  {
    return { numberBelow(given, count, "--pilot") };
  }
  std::vector<std::size_t> pilots{ 0, count / 2, count - 1 };
  pilots.erase(std::unique(pilots.begin(), pilots.end()), pilots.end());
  return pilots;
}

void writeSlurmScript(const SweepOptions& options, const std::vector<std::size_t>& pilots)
{
  Manifest manifest(options.folder);
  const CaseCost cost = runPilots(manifest, pilots);
  const auto script = writeSlurm(options.folder,
    { .count = manifest.head().count,
      .tasks = options.tasks,
      .seconds = cost.seconds,
      .memory = cost.memory });
  std::cerr << "palp: sbatch " << quoted(script.string()) << '\n';
}

void planInto(
  const std::filesystem::path& folder, const Sweep& sweep, const std::filesystem::path& beside)
{
  const PlanTold told = planSweep(sweep, beside, caseOptions(sweep.kind), checkCase, folder);
  std::cerr << "palp: " << counted(told.count, "case") << " planned in " << folder.string() << ", "
            << told.done << " done\n";
}

std::filesystem::path folderOf(const std::string& file)
{
  return std::filesystem::absolute(sweepFile(file)).parent_path();
}

void plan(const SweepOptions& options)
{
  const Sweep sweep = readSweepFile(options.file);
  const std::vector<std::size_t> pilots = pilotsOf(options.pilot, sweep.count());
  if (options.slurm || options.parallel)
  {
    (void)plainPlace(options.folder); // before anything is computed
  }
  planInto(options.folder, sweep, folderOf(options.file));
  if (options.parallel)
  {
    const auto script = writeParallel(options.folder, sweep.count());
    std::cerr << "palp: sh " << quoted(script.string()) << " -j 2\n";
  }
  if (options.slurm)
  {
    writeSlurmScript(options, pilots);
  }
}

// NAME.png of each, in place of those before
void draw(const SweepFigures& drawn, const std::filesystem::path& folder, bool isPartial,
  const Renderer& pictures)
{
  std::vector<std::string> names;
  for (const figures::Figure& figure : drawn.figures)
  {
    names.push_back(figure.name + ".png");
  }
  OutputFolder output(folder.empty() ? "." : folder, names, OutputFolder::Earlier::Keep);
  pictures.drawFigures(drawn.figures, drawn.tables, figures::Layout::Alone, output.stage());
  output.publish();
  if (!drawn.refused.empty())
  {
    const std::size_t others = drawn.refused.size() - 1;
    throw Error(ErrorCode::BadFile,
      (isPartial ? "of what is finished so far: " : "") + drawn.refused.front() +
        (others > 0 ? " (and " + counted(others, "plot") + " more)" : ""));
  }
}

void merge(const SweepOptions& options, const Renderer* pictures)
{
  if (options.plots && !pictures)
  {
    execProgram("palp-draw");
  }
  Manifest manifest(options.folders.front());
  if (options.plots && manifest.head().plots.empty())
  {
    throw Error(ErrorCode::BadValue,
      "--plots: this sweep has none; write \"plots\" into its SWEEP.json and plan again, which "
      "keeps "
      "what is finished, or leave it out");
  }
  MergeOptions how = options.merge;
  how.others.assign(options.folders.begin() + 1, options.folders.end());
  const Merged merged = mergeResults(manifest, how, options.out);
  for (const std::string& file : InputWatch::edited(manifest.head().files))
  {
    std::cerr << "palp: warning: " << file
              << ": was edited after planning; these are the results of what it held before\n";
  }
  std::cerr << "palp: " << counted(merged.cases, "case") << ", " << counted(merged.rows, "row")
            << " in " << options.out.string() << '\n';
  if (options.plots)
  {
    draw(sweepFigures(manifest, how), options.out.parent_path(), how.partial, *pictures);
  }
}

void addPlan(CLI::App& sweep, const std::shared_ptr<SweepOptions>& options)
{
  CLI::App* command = sweep.add_subcommand("plan", "Write the cases of a SWEEP.json into a folder");
  command->add_option("SWEEP", options->file, "Sweep (JSON), or the name of a shipped one")
    ->required();
  command
    ->add_option("DIR", options->folder,
      "Folder of the sweep; what it holds is kept, but for the scripts below")
    ->required();
  CLI::Option* slurm = command->add_flag("--slurm", options->slurm,
    "Run pilot cases, and write a job array for Slurm by what they took, anew: DIR/sweep.sbatch");
  command
    ->add_option("--pilot", options->pilot,
      "The pilot case, a long one; else the first, the middle and the last")
    ->needs(slurm);
  command
    ->add_option("--tasks", options->tasks,
      "Most tasks of the array, less than MaxArraySize of the cluster; each takes several cases "
      "where there are more")
    ->check(CLI::Range(std::size_t{ 1 }, kMostCases))
    ->capture_default_str()
    ->needs(slurm);
  command->add_flag(
    "--parallel", options->parallel, "Write the line for GNU parallel, anew: DIR/parallel.sh");
  command->footer("data/sweeps/sweep.schema.json describes the file.\n"
                  "Examples:\n"
                  "  palp sweep plan SWEEP.json DIR\n"
                  "  palp sweep plan extent DIR --slurm; sbatch DIR/sweep.sbatch\n"
                  "  palp sweep plan extent DIR --parallel; sh DIR/parallel.sh -j 8");
  command->callback([options] { plan(*options); });
}

void addRun(CLI::App& sweep, const std::shared_ptr<SweepOptions>& options)
{
  CLI::App* command = sweep.add_subcommand(
    "run", "Compute cases that are not finished: one, a part, or all that are planned");
  command->add_option("DIR", options->folder, "Folder of the sweep")->required();
  CLI::Option* number = command->add_option(
    "--case", options->number, "One case, from 0; SLURM_ARRAY_TASK_ID where that is set");
  CLI::Option* shard =
    command->add_option("--shard", options->shard, "A part of all, 2/4 for the second of four")
      ->excludes(number);
  command
    ->add_option("--chunk", options->chunk,
      "That many cases in a row instead of one, those of --case 2 after those of --case 1")
    ->check(CLI::Range(std::size_t{ 1 }, kMostCases))
    ->excludes(shard);
  command->add_option("--jobs", options->jobs, "Cases at a time, each a process")
    ->check(CLI::Range(1, 10'000))
    ->capture_default_str();
  command->add_flag("--check", options->checks,
    "Also those whose result is damaged: cut, edited, or of another case");
  command->footer(
    "A finished case is never computed again; one that failed is tried again.\n"
    "Examples:\n"
    "  palp sweep run DIR --jobs 2                 all of it on this machine\n"
    "  palp sweep run DIR --shard 1/2              half of it; the other half elsewhere\n"
    "  palp sweep run DIR --case 17                one case\n"
    "  sbatch --array=0-119 --requeue --wrap \"palp sweep run DIR\"\n"
    "  seq 0 119 | parallel --joblog DIR/log --resume-failed palp sweep run DIR --case {}");
  command->callback(
    [options]
    {
      Manifest manifest(options->folder);
      run(manifest, numbersOf(*options, manifest), options->jobs, options->checks);
    });
}

void addMerge(
  CLI::App& sweep, const std::shared_ptr<SweepOptions>& options, const Renderer* pictures)
{
  CLI::App* command =
    sweep.add_subcommand("merge", "All results as one table: what was varied, and what came out");
  command
    ->add_option(
      "DIR", options->folders, "Folder of the sweep, and others with results of the same")
    ->required();
  command->add_option("--out", options->out, "Table to write, .csv or .vtt (VTK)")->required();
  command->add_flag("--overwrite", options->merge.overwrite, "Replace the table that is there");
  command->add_option("--largest", options->merge.largest,
    "Of each case only the row in which this column is largest");
  command->add_flag("--partial", options->merge.partial, "Leave out the cases that have no result");
  command->add_flag("--plots", options->plots, "Draw the plots of the SWEEP.json beside --out");
  command->footer("Examples:\n"
                  "  palp sweep merge DIR --out all.csv\n"
                  "  palp sweep merge DIR --out peaks.vtt --largest force_N\n"
                  "  palp sweep merge HERE THERE --out all.csv --plots");
  command->callback([options, pictures] { merge(*options, pictures); });
}

} // namespace

void runCalibrations(const std::string& file, const std::filesystem::path& folder, unsigned jobs)
{
  const Sweep sweep = readSweepFile(file);
  if (sweep.kind != "calibrate")
  {
    throw Error(ErrorCode::BadFile,
      "--sweep: " + inQuotes(file) + " is of palp " + sweep.kind + "; give it to palp sweep plan");
  }
  planInto(folder, sweep, folderOf(file));
  Manifest manifest(folder);
  run(manifest, manifest.numbers(), jobs, false);
}

void addSweepCommand(CLI::App& app, const Renderer* pictures)
{
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command =
    app.add_subcommand("sweep", "Many cases of calibrate, force or run, on one machine or many");
  command->require_subcommand(1);
  addPlan(*command, options);
  addRun(*command, options);
  CLI::App* status = command->add_subcommand("status", "How far a sweep is, and what failed");
  status->add_option("DIR", options->folder, "Folder of the sweep")->required();
  status->footer("Examples:\n"
                 "  palp sweep status DIR\n"
                 "  watch palp sweep status DIR                 while others compute it");
  status->callback(
    [options]
    {
      Manifest manifest(options->folder);
      std::cout << describe(statusOf(manifest), manifest.head());
    });
  addMerge(*command, options, pictures);
  command->footer("Examples:\n"
                  "  palp sweep plan extent DIR\n"
                  "  palp sweep run DIR --jobs 2\n"
                  "  palp sweep status DIR\n"
                  "  palp sweep merge DIR --out all.csv");
}

} // namespace palp
