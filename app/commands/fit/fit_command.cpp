#include "app/commands/fit/fit_command.h"

#include "app/commands/fit/file_fit.h"
#include "app/curves/force_curve.h"
#include "app/headless/renderer.h"
#include "app/input/law_options.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/quantity.h"
#include "app/input/tip_text.h"
#include "app/program/exec_program.h"
#include "app/program/output.h"
#include "app/program/progress_line.h"
#include "calibration/fit/fit_figures.h"
#include "calibration/fit/loading_rows.h"
#include "calibration/fit/modulus_fit.h"
#include "haptics/error.h"
#include "haptics/files/replace_file.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

namespace palp
{
namespace
{

using fit::FittedCurve;
using Json = nlohmann::ordered_json;
using units::toMillimeters;

constexpr double kUnitModulus = 1.0; // [Pa]; no rule of a law depends on it

struct FitOptions
{
  std::vector<std::filesystem::path> files;
  Tip tip;
  double poisson = 0.33;
  LawOptions law;
  GeometryOptions geometry;
  bool searchThickness = false;
  std::optional<double> contact; // [m]
  std::optional<double> offset;  // [N]
  std::filesystem::path out;
  bool overwrite = false;
  bool noPicture = false;
};

fit::ModulusQuestion questionOf(const FitOptions& options)
{
  LawOptions all = options.law; // the corrected law is fitted, too
  all.mode = LawMode::Corrected;
  fit::ModulusQuestion question{ .tip = options.tip,
    .poissonRatio = makeMaterial(kUnitModulus, options.poisson).poissonRatio,
    .settings = all.settings(),
    .place = options.geometry.geometry,
    .searchThickness = options.searchThickness,
    .contact = options.contact,
    .offset = options.offset };
  question.settings.mode = options.searchThickness ? LawMode::Corrected : options.law.mode;
  return question;
}

FileFit fitFile(const std::filesystem::path& file, const fit::ModulusQuestion& question)
{
  const ForceRows read = readContactRows(file);
  const ReferenceCurve& whole = read.curve;
  try
  {
    const fit::Rows rows = fit::loadingRows(whole.x);
    const auto part = [&](const std::vector<double>& values) {
      return Eigen::VectorXd::Map(
        values.data() + rows.first, static_cast<Eigen::Index>(rows.count));
    };
    fit::Measured loading{ .depths = part(whole.x), .forces = part(whole.y) };
    const fit::ModulusFit fitted = fit::fitModulus(loading, question);
    const ForceLaw law(question.tip, { kUnitModulus, question.poissonRatio }, question.settings);
    const Validity validity(law, { .deepest = fitted.deepest.depth });
    return { .curve = { .name = whole.name, .loading = std::move(loading), .fit = fitted },
      .rows = rows,
      .rowsInFile = whole.x.size(),
      .note = noteOfTool(read, question.tip),
      .outside = brokenNames(validity(fitted.deepest)) };
  }
  catch (const Error& error)
  {
    throw Error(error.code(), file.string() + ": " + error.what());
  }
}

// each by a name of its own
std::vector<FileFit> fitFiles(const FitOptions& options)
{
  const fit::ModulusQuestion question = questionOf(options);
  ProgressLine progress("curves");
  std::vector<FileFit> fits;
  for (const auto& file : options.files)
  {
    progress(fits.size(), options.files.size());
    fits.push_back(fitFile(file, question));
    const auto isSame = [&](const std::filesystem::path& other)
    { return other.stem() == file.stem(); };
    if (std::ranges::count_if(options.files, isSame) > 1)
    {
      fits.back().curve.name = file.string();
    }
  }
  return fits;
}

Json settingsJson(const FitOptions& options)
{
  const ContactGeometry& place = options.geometry.geometry;
  const auto optional = [](const std::optional<double>& value, double unit)
  { return value ? Json(*value / unit) : Json("searched"); };
  const double mm = units::fromMillimeters(1.0);
  const fit::ModulusQuestion question = questionOf(options);
  return { { "tool", describeTip(options.tip) }, { "poisson", options.poisson },
    { "law", describeLaw(question.settings) },
    { "base", kBases.at(static_cast<std::size_t>(question.settings.base)) },
    { "material", kMaterials.at(static_cast<std::size_t>(question.settings.constitution)) },
    { "thickness_mm",
      options.searchThickness ? Json("searched") : Json(toMillimeters(place.thickness)) },
    { "surface_curvature_per_mm", place.surfaceCurvature * mm },
    { "curvature_spread_per_mm", place.curvatureSpread * mm },
    { "tilt_deg", units::toDegrees(place.tilt) }, { "contact_mm", optional(options.contact, mm) },
    { "offset_N", optional(options.offset, 1.0) }, { "confidence", fit::kConfidence },
    { "intervals", "profile likelihood" } };
}

// one curve stands by itself, several in a list
Json allJson(const FitOptions& options, const std::vector<FileFit>& fits)
{
  Json curves = Json::array();
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    curves.push_back(fitJson(fits[i], options.files[i]));
  }
  Json json{ { "palp", PALP_VERSION }, { "command", commandLine() },
    { "settings", settingsJson(options) } };
  if (curves.size() == 1)
  {
    json.update(curves[0]);
  }
  else
  {
    json["curves"] = std::move(curves);
  }
  return json;
}

void runFit(const FitOptions& options, const Renderer* pictures)
{
  if (!options.noPicture && !pictures)
  {
    execProgram("palp-draw");
  }
  if (options.geometry.given && questionOf(options).settings.mode != LawMode::Corrected)
  {
    std::cerr
      << "palp: thickness, surface and tilt change what is fitted with --law corrected only\n";
  }
  std::vector<std::filesystem::path> inputs = options.files;
  inputs.push_back(fileOf(options.tip));
  Outputs outputs;
  OutputFolder& output = outputs.open(
    options.out, { "fit.json", "fit.csv", "fit.png", "residuals.png" }, options.overwrite, inputs);
  const std::vector<FileFit> fits = fitFiles(options);
  std::vector<FittedCurve> curves;
  std::ranges::transform(fits, std::back_inserter(curves), &FileFit::curve);
  const std::array tables{ fit::fitTable(curves) };
  replaceFile(output.stage() / "fit.json", allJson(options, fits).dump(2) + "\n");
  replaceFile(output.stage() / "fit.csv", figures::csv(tables[0]));
  if (!options.noPicture)
  {
    pictures->drawFigures(fit::fitFigures(curves), tables, figures::Layout::Alone, output.stage());
  }
  output.publish();
  for (const FileFit& file : fits)
  {
    tellResult(file);
    tellLimits(file, !options.offset);
  }
}

} // namespace

void addFitCommand(CLI::App& app, const Renderer* pictures)
{
  auto options = std::make_shared<FitOptions>();
  CLI::App* command =
    app.add_subcommand("fit", "Find Young's modulus, with its interval, from measured curves");
  command->add_option("FILES", options->files, "Curves: CSV with columns depth_mm,force_N")
    ->required();
  addTip(*command, options->tip, "")->required();
  addPoisson(*command, options->poisson);
  options->law.addUncoatedTo(*command);
  options->geometry.addTo(*command);
  addParsed(*command, "--fit", "thickness: search it too, by the corrected law", "",
    [options = options.get()](const std::string&) { options->searchThickness = true; })
    ->check(CLI::IsMember({ "thickness" }))
    ->excludes("--thickness");
  addParsed(*command, "--contact", "Depth at which the tool touches; searched if none", "",
    [options = options.get()](const std::string& text)
    { options->contact = parseQuantity(text, Quantity::Length, "--contact"); });
  addParsed(*command, "--offset",
    "Force that the sensor tells before the contact; searched if none", "",
    [options = options.get()](const std::string& text)
    { options->offset = parseQuantity(text, Quantity::Force, "--offset"); });
  command->add_option("--out", options->out, "Folder for fit.json, fit.csv and plots")->required();
  addOverwrite(*command, options->overwrite);
  command->add_flag("--no-picture", options->noPicture, "Write the data only");
  command->footer(
    "Of each file the loading is fitted, up to its deepest row. Intervals of 95 % hold what is\n"
    "not known of contact, offset and thickness, for independent noise in the force; low and\n"
    "high are null in fit.json where the curve does not tell them. exponent: of depth, by a power\n"
    "law of its own. laws: every law of the tool; the lowest aic explains the curve best.\n"
    "Examples:\n"
    "  palp fit press.csv --tip sphere:4mm --poisson 0.45 --out fit\n"
    "  palp fit day1.csv day2.csv --tip cone:45deg:10mm --law exact --offset 0N --out fit\n"
    "  palp fit press.csv --tip punch:5mm --fit thickness --material linear --out fit");
  command->callback([options, pictures] { runFit(*options, pictures); });
}

} // namespace palp
