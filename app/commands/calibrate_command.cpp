#include "app/commands/calibrate_case.h"
#include "app/commands/commands.h"
#include "app/headless/renderer.h"
#include "app/input/tip_text.h"
#include "app/program/exec_program.h"
#include "app/program/interrupt.h"
#include "app/program/output.h"
#include "app/program/progress_line.h"
#include "calibration/study/shipped_tables.h"
#include "calibration/study/study.h"
#include "calibration/study/study_files.h"
#include "haptics/error.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <set>

namespace palp
{
namespace
{

using namespace fem;

struct CalibrateOptions
{
  CaseText text;
  std::filesystem::path out = "calibration";
  std::string sweep;
  std::filesystem::path tables;
  unsigned jobs = 1;
  bool resume = false;
  bool overwrite = false;
  bool noPicture = false;
};

std::unique_ptr<OutputFolder> openFolder(
  const std::filesystem::path& folder, const CalibrateOptions& options, const Tip& tip)
{
  const std::vector<std::filesystem::path> inputs{ fileOf(tip) };
  if (!options.resume)
  {
    return openOutput(folder, calibrationFiles(), options.overwrite, inputs);
  }
  keepInputs(folder, calibrationFiles(), inputs);
  return std::make_unique<OutputFolder>(folder, calibrationFiles(), OutputFolder::Earlier::Keep);
}

constexpr const char* kStopped =
  "interrupted; what was reached is complete in --out, --resume goes on from here";

constexpr const char* kNothingYet =
  "interrupted before the first depth was done; what is in --out is as before";

constexpr const char* kTablesStopped =
  "interrupted; the tables that were not finished are as before, start again for them";

// before any picture is drawn
void refuseWhereStopped(const Interrupt& interrupt, const char* sentence)
{
  if (interrupt.token().stop_requested())
  {
    throw Error(ErrorCode::NoSolution, sentence);
  }
}

Case studyOf(const CalibrateOptions& options)
{
  return caseOf((options.out / "").parent_path().filename().string(), options.text);
}

void calibrateOne(const CalibrateOptions& options, Interrupt& interrupt, const Renderer* pictures)
{
  const Case study = studyOf(options);
  const auto folder = openFolder(options.out, options, study.tip);
  const bool goesOn = options.resume && std::filesystem::exists(options.out / "table.csv");
  interrupt.endWhatDoesNotStop(goesOn ? kStopped : kNothingYet);
  Outcome outcome;
  {
    ProgressLine progress("depths");
    progress(0, study.depths.size());
    outcome = calibrateInto(*folder, study, options.resume, interrupt.token(),
      [&](std::size_t done, std::size_t total)
      {
        progress(done, total);
        interrupt.endWhatDoesNotStop(kStopped);
      });
  }
  refuseWhereStopped(interrupt, outcome.steps.empty() ? kNothingYet : kStopped);
  if (!options.noPicture)
  {
    pictures->drawCalibration(study, outcome.steps, folder->stage());
    folder->publish();
  }
  if (!outcome.error.empty())
  {
    throw Error(ErrorCode::NoSolution,
      outcome.error + " (" + std::to_string(outcome.steps.size()) + " of " +
        std::to_string(study.depths.size()) + " depths are in " + options.out.string() + ")");
  }
  std::cerr << "palp: " << (options.noPicture ? "tables and fit" : "tables, fit and pictures")
            << " are in " << options.out.string() << '\n';
}

std::vector<std::string> tablesIn(const std::filesystem::path& folder)
{
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing))
  {
    if (entry.path().extension() == ".csv")
    {
      names.push_back(entry.path().filename().string());
    }
  }
  return names;
}

void runCalibration(const CalibrateOptions& options, const Renderer* pictures)
{
  if (!options.sweep.empty())
  {
    runCalibrations(options.sweep, options.out, options.jobs);
    return;
  }
  if (options.tables.empty() && !options.noPicture && !pictures)
  {
    execProgram("palp-draw");
  }
  Interrupt interrupt;
  if (!options.tables.empty())
  {
    interrupt.endWhatDoesNotStop(kTablesStopped);
    const auto folder = openOutput(options.tables,
      options.overwrite ? std::vector<std::string>{} : tablesIn(options.tables), options.overwrite);
    makeShippedTables(folder->stage(), interrupt.token(),
      [](const std::string& name) { std::cerr << "palp: " << name << '\n'; });
    refuseWhereStopped(interrupt, kTablesStopped);
    folder->publish();
  }
  else
  {
    calibrateOne(options, interrupt, pictures);
  }
}

// what an option stands instead of
void refuseBeside(CLI::App& command, CLI::Option& option, const std::set<std::string>& allowed)
{
  for (CLI::Option* other : command.get_options())
  {
    if (!allowed.contains(other->get_lnames().front()))
    {
      option.excludes(other);
    }
  }
}

} // namespace

void addCalibrateCommand(CLI::App& app, const Renderer* pictures, Work work)
{
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command = app.add_subcommand(
    "calibrate", "Find R_d(depth) and the force by finite elements, for any tool and block");
  const auto text = [&](const char* name, const char* what)
  {
    command->add_option("--" + std::string(name), options->text.values.at(name), what)
      ->capture_default_str();
  };
  text("block", "Width x length x height of the block");
  text("tip", "Tool, as for palp force");
  text("cap", "Radius of the cap of a sharp cone and of the edge of a flat, 0mm for none");
  text("young", "Young's modulus; without coatings it scales the force and leaves R_d alone");
  text("poisson", "Poisson's ratio, less than 0.5");
  text("material", "linear, corotated, neo-hookean or neo-hookean-isochoric");
  text("depth", "Indentation depths A:B:STEP");
  text("threshold", "Displacement at the edge of the deformed region");
  text("model", "axisymmetric, or block: the paper's 30 x 30 x 10 nodes");
  text("base", "Under the block: bonded, or slip for one that slides on its support");
  text("coating", "On the block, its height included: THICKNESS:YOUNG:NU from the surface down");
  text("nodule", "A ball on the axis: RADIUS:TOP:RATIO, TOP the depth of its highest point");
  text("stiffness", "Young's modulus that differs: formula:6+0.1*z, r from the axis, z the depth");
  text("element-size", "Under the tool; 0.5mm, or a tenth of its radius in the block");
  command->add_option("--out", options->out, "Folder for the results")->capture_default_str();
  command->add_flag("--resume", options->resume, "Go on from what --out holds");
  addOverwrite(*command, options->overwrite);
  command->add_flag("--no-picture", options->noPicture, "Write the data only");
  CLI::Option* sweep = command->add_option("--sweep", options->sweep,
    "Instead: palp sweep plan of this file into --out, and palp sweep run of it");
  command->add_option("--jobs", options->jobs, "Cases of the sweep at a time")
    ->check(CLI::Range(1, 10'000))
    ->needs(sweep)
    ->capture_default_str();
  CLI::Option* tables =
    command->add_option("--tables", options->tables, "Make the shipped tables in this folder");
  refuseBeside(*command, *sweep, { "help", "jobs", "out", "sweep" });
  refuseBeside(*command, *tables, { "help", "overwrite", "tables" });
  command->footer(
    "Examples:\n"
    "  palp calibrate --tip sphere:10mm --block 100x100x50mm --out sphere\n"
    "  palp calibrate --tip cone:45deg:10mm --material corotated --depth 0.5:6:0.5mm --out cone\n"
    "  palp calibrate --young 5kPa --coating 2mm:50kPa:0.45 --out skin\n"
    "  palp calibrate --poisson 0.45 --nodule 5mm:5mm:5 --material linear --out nodule\n"
    "  palp calibrate --poisson 0.45 --stiffness 'formula:if(z<2,150,50)' --out skin_map\n"
    "  palp calibrate --sweep extent --jobs 2 --out DIR; palp sweep merge DIR --out all.csv\n"
    "  palp calibrate --tables data/tables --overwrite   make the shipped tables again");
  command->callback([options, pictures, work]
    { work == Work::Check ? (void)studyOf(*options) : runCalibration(*options, pictures); });
}

} // namespace palp
