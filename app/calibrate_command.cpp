#include "app/coating_spec.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/pictures.h"
#include "app/program.h"
#include "app/quantity.h"
#include "app/tip_spec.h"
#include "calibration/shipped_tables.h"
#include "calibration/study.h"
#include "calibration/study_files.h"
#include "haptics/error.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace palp
{
namespace
{

using namespace fem;
using Clock = std::chrono::steady_clock;

// a case as text with units, by the name of its option
struct CaseText
{
  std::map<std::string, std::string> values{ { "block", "100x100x50mm" }, { "tip", "sphere:10mm" },
    { "young", "50kPa" }, { "poisson", "0.33" }, { "material", "neo-hookean" },
    { "depth", "0.5:10:0.5mm" }, { "threshold", "0.5mm" }, { "cap", "0.3mm" },
    { "model", "axisymmetric" }, { "element-size", "" }, { "coating", "" } };
};

// A x B x C; a unit on the last number counts for all
std::array<double, 3> parseBlock(const std::string& text)
{
  const auto digits = text.find_last_of("0123456789.");
  const std::string unit = digits == std::string::npos ? "" : text.substr(digits + 1);
  std::array<double, 3> sides{};
  std::istringstream parts(text);
  std::string part;
  for (double& side : sides)
  {
    if (!std::getline(parts, part, 'x'))
    {
      throw Error(ErrorCode::BadValue,
        "--block: '" + text + "' has fewer than three sides; give " +
          "width, length and height, as 100x100x50mm");
    }
    const bool bare = part.find_first_not_of("0123456789.") == std::string::npos;
    side = parseQuantity(bare ? part + unit : part, Quantity::Length, "--block (as 100x100x50mm)");
  }
  if (!parts.eof())
  {
    throw Error(ErrorCode::BadValue,
      "--block: '" + text + "' has more than three sides; give three, as 100x100x50mm");
  }
  return sides;
}

Case caseOf(const std::string& name, const CaseText& text)
{
  const auto value = [&](const char* key) -> const std::string& { return text.values.at(key); };
  const auto length = [&](const char* key)
  { return parseQuantity(value(key), Quantity::Length, "--" + std::string(key)); };
  const auto energy = energyNamed(value("material"));
  if (!energy)
  {
    throw Error(ErrorCode::BadValue,
      "--material: '" + value("material") +
        "' is unknown; give linear, corotated, neo-hookean or neo-hookean-isochoric");
  }
  const std::string& model = value("model");
  if (model != "axisymmetric" && model != "block")
  {
    throw Error(
      ErrorCode::BadValue, "--model: '" + model + "' is unknown; give axisymmetric or block");
  }
  const auto [width, depth, height] = parseBlock(value("block"));
  Case study{ .name = name,
    .width = width,
    .length = depth,
    .height = height,
    .tip = withCap(parseTip(value("tip")), length("cap")),
    .material = makeMaterial(parseQuantity(value("young"), Quantity::Pressure, "--young"),
      parseNumber(value("poisson"), "--poisson")),
    .coatings = parseCoatings(value("coating")),
    .energy = *energy,
    .depths = parseRange(value("depth"), Quantity::Length, "--depth").si,
    .threshold = length("threshold"),
    .model = model == "block" ? BodyModel::Block : BodyModel::Axisymmetric,
    .elementSize = value("element-size").empty() ? 0.0 : length("element-size") };
  if (study.depths.front() == 0.0)
  {
    study.depths.erase(study.depths.begin()); // nothing happens at first touch
  }
  check(study);
  return study;
}

std::vector<Case> readSweep(const std::filesystem::path& file, const CaseText& defaults)
{
  std::ifstream in(file);
  if (!in)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": cannot be read; check the name");
  }
  std::vector<Case> cases;
  try
  {
    const auto list = nlohmann::json::parse(in);
    for (const auto& entry : list)
    {
      CaseText text = defaults;
      for (const auto& [key, value] : entry.items())
      {
        if (key != "name" && !text.values.contains(key))
        {
          throw Error(ErrorCode::BadFile,
            file.string() + ": '" + key +
              "' is no setting of a case; use the names of the options");
        }
        text.values[key] = value.get<std::string>();
      }
      cases.push_back(caseOf(entry.at("name").get<std::string>(), text));
    }
  }
  catch (const nlohmann::json::exception& error)
  {
    throw Error(ErrorCode::BadFile,
      file.string() +
        ": not a list of cases such as [{\"name\": \"soft\", \"young\": \"5kPa\"}]; " +
        error.what());
  }
  return cases;
}

// one line that is written over itself, on a terminal only
class ProgressBar
{
public:
  void operator()(std::size_t done, std::size_t total) const
  {
    if (isatty(STDERR_FILENO) == 0)
    {
      return;
    }
    const std::chrono::duration<double> spent = Clock::now() - start_;
    const auto left = static_cast<double>(total - done) / static_cast<double>(done);
    constexpr std::size_t kWidth = 30;
    const std::size_t filled = kWidth * done / total;
    std::cerr << "\r[" << std::string(filled, '#') << std::string(kWidth - filled, '.') << "] "
              << done << " of " << total << " depths, about " << std::lround(left * spent.count())
              << " s left   " << (done == total ? "\n" : "") << std::flush;
  }

private:
  Clock::time_point start_ = Clock::now();
};

struct CalibrateOptions
{
  CaseText text;
  std::filesystem::path out = "calibration";
  std::filesystem::path sweep;
  std::filesystem::path tables;
  unsigned jobs = 1;
  bool resume = false;
  bool overwrite = false;
  bool noPicture = false;
};

std::unique_ptr<OutputFolder> openFolder(
  const std::filesystem::path& folder, const CalibrateOptions& options)
{
  return options.resume
    ? std::make_unique<OutputFolder>(folder, calibrationFiles(), OutputFolder::Earlier::Keep)
    : openOutput(folder, calibrationFiles(), options.overwrite);
}

void runSweep(const CalibrateOptions& options, std::stop_token stop, const Pictures* pictures)
{
  const auto cases = readSweep(options.sweep, options.text);
  const OutputFolder whole(options.out, {}, OutputFolder::Earlier::Keep); // one sweep in a folder
  std::vector<std::unique_ptr<OutputFolder>> folders;
  for (const Case& study : cases)
  {
    folders.push_back(openFolder(options.out / study.name, options));
  }
  std::size_t failed = 0;
  sweep(folders, cases, options.resume, options.jobs, stop,
    [&](const std::string& name, const std::string& trouble)
    {
      failed += trouble.empty() ? 0 : 1;
      std::cerr << "palp: " << name << ": " << (trouble.empty() ? "done" : trouble) << '\n';
    });
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    if (!options.noPicture && std::filesystem::exists(folders[i]->path() / "table.csv"))
    {
      pictures->drawCalibration(cases[i], readSteps(folders[i]->path()), folders[i]->stage());
      folders[i]->publish();
    }
  }
  if (failed > 0)
  {
    throw Error(ErrorCode::NoSolution,
      std::to_string(failed) + " of " + std::to_string(cases.size()) +
        " cases are incomplete; the depths that were reached are in " + options.out.string());
  }
}

void calibrateOne(const CalibrateOptions& options, std::stop_token stop, const Pictures* pictures)
{
  const Case study = caseOf(options.out.filename().string(), options.text);
  const auto folder = openFolder(options.out, options);
  const Outcome outcome = calibrateInto(*folder, study, options.resume, stop, ProgressBar());
  if (!options.noPicture)
  {
    pictures->drawCalibration(study, outcome.steps, folder->stage());
    folder->publish();
  }
  if (!outcome.trouble.empty())
  {
    throw Error(ErrorCode::NoSolution,
      outcome.trouble + " (" + std::to_string(outcome.steps.size()) + " of " +
        std::to_string(study.depths.size()) + " depths are in " + options.out.string() + ")");
  }
  std::cerr << "palp: tables, fit and pictures are in " << options.out.string() << '\n';
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

void runCalibration(const CalibrateOptions& options, const Pictures* pictures)
{
  if (options.tables.empty() && !options.noPicture && !pictures)
  {
    becomeSibling("palp-draw");
  }
  const Interrupt interrupt;
  if (!options.tables.empty())
  {
    const auto folder = openOutput(options.tables,
      options.overwrite ? std::vector<std::string>{} : tablesIn(options.tables), options.overwrite);
    makeShippedTables(folder->stage(), interrupt.token(),
      [](const std::string& name) { std::cerr << "palp: " << name << '\n'; });
    if (interrupt.token().stop_requested())
    {
      throw Error(
        ErrorCode::NoSolution, "interrupted; " + options.tables.string() + " is as it was");
    }
    folder->publish();
  }
  else if (!options.sweep.empty())
  {
    runSweep(options, interrupt.token(), pictures);
  }
  else
  {
    calibrateOne(options, interrupt.token(), pictures);
  }
}

} // namespace

void addCalibrateCommand(CLI::App& app, const Pictures* pictures)
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
  text("cap", "Radius of the spherical cap that a sharp cone gets, 0mm for none");
  text("young", "Young's modulus; without coatings it scales the force and leaves R_d alone");
  text("poisson", "Poisson's ratio, less than 0.5");
  text("material", "linear, corotated, neo-hookean or neo-hookean-isochoric");
  text("depth", "Indentation depths A:B:STEP");
  text("threshold", "Displacement at the edge of the deformed region");
  text("model", "axisymmetric, or block: the paper's 30 x 30 x 10 nodes");
  text("coating", "On the block, its height included: THICKNESS:YOUNG:NU from the surface down");
  text("element-size", "Under the tool; 0.5mm, or a tenth of its radius in the block");
  command->add_option("--out", options->out, "Folder for the results")->capture_default_str();
  command->add_flag("--resume", options->resume, "Go on from what --out holds");
  addOverwrite(*command, options->overwrite);
  command->add_option("--sweep", options->sweep,
    "A list of cases in JSON: the names above with their values, and a \"name\" each");
  command->add_option("--jobs", options->jobs, "Cases of a sweep at a time")->capture_default_str();
  command->add_option("--tables", options->tables, "Make the shipped tables in this folder");
  command->footer(
    "Examples:\n"
    "  palp calibrate --tip sphere:10mm --block 100x100x50mm --out sphere\n"
    "  palp calibrate --tip cone:45deg:10mm --material corotated --depth 0.5:6:0.5mm --out cone\n"
    "  palp calibrate --young 5kPa --coating 2mm:50kPa:0.45 --out skin\n"
    "  palp calibrate --sweep cases.json --jobs 2 --out sweep --resume\n"
    "  palp calibrate --tables data/tables --overwrite   make the shipped tables again");
  command->add_flag("--no-picture", options->noPicture, "Write the data only");
  command->callback([options, pictures] { runCalibration(*options, pictures); });
}

} // namespace palp
