#include "app/commands/commands.h"
#include "app/headless/renderer.h"
#include "app/input/law_options.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/quantity.h"
#include "app/input/tip_text.h"
#include "app/program/exec_program.h"
#include "app/program/output.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"
#include "haptics/force/nodules/detection.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using units::toMillimeters;

constexpr const char* kName = "detect"; // of table, file and figure
constexpr std::size_t kMostCovers = 1000;

struct DetectOptions
{
  TissueOptions tissue;
  GeometryOptions geometry;
  Range covers;
  double ratio = 0.0;
  double depth = 0.0; // [m]
  std::filesystem::path out;
  bool overwrite = false;
  bool noPicture = false;
};

Range coversOf(const std::string& text)
{
  Range covers = parseRange(text, Quantity::Length, "--cover");
  if (covers.si.front() < 0.1_mm || covers.si.back() > 1.0 || covers.si.size() > kMostCovers)
  {
    throw Error(ErrorCode::BadValue,
      "--cover: " + inQuotes(text) + " is out of range; give at most " +
        std::to_string(kMostCovers) + " depths of 0.1mm to 1m");
  }
  return covers;
}

double ratioOf(const std::string& text)
{
  const double ratio = parseNumber(text, "--ratio");
  if (ratio == 1.0)
  {
    throw Error(ErrorCode::BadValue,
      "--ratio: a nodule as stiff as the tissue cannot be felt; give 0.2 to 50, but not 1");
  }
  if (!(ratio >= 0.2 && ratio <= 50.0))
  {
    throw Error(
      ErrorCode::BadValue, "--ratio: " + inQuotes(text) + " is out of range; give 0.2 to 50");
  }
  return ratio;
}

ContactGeometry placeOf(const DetectOptions& options)
{
  ContactGeometry place = options.geometry.geometry;
  place.depth = options.depth;
  if (options.covers.si.back() >= place.thickness)
  {
    throw Error(ErrorCode::BadValue,
      "--cover: " + shortest(toMillimeters(options.covers.si.back())) +
        "mm is below the base of the body; give less than its --thickness of " +
        shortest(toMillimeters(place.thickness)) + "mm");
  }
  return place;
}

std::string percentOf(const JustNoticeable& difference)
{
  return shortest(std::round(1e3 * difference.fraction) / 10.0);
}

std::string columnOf(const JustNoticeable& difference)
{
  return "diameter_at_" + percentOf(difference) + "_percent_mm";
}

figures::Table emptyTable()
{
  figures::Table table{
    .name = kName, .caption = "Smallest nodule that can be felt", .columns = { "cover_mm" }
  };
  for (const JustNoticeable& difference : kJustNoticeable)
  {
    table.columns.push_back(columnOf(difference));
  }
  for (const JustNoticeable& difference : kJustNoticeable)
  {
    table.columns.push_back("outside_limits_at_" + percentOf(difference) + "_percent");
  }
  return table;
}

figures::Table detect(const DetectOptions& options)
{
  const NoduleContrast contrast(options.tissue.law(), placeOf(options));
  figures::Table table = emptyTable();
  for (std::size_t i = 0; i < options.covers.si.size(); ++i)
  {
    std::vector<figures::Cell> diameters{ options.covers.given[i] *
      toMillimeters(options.covers.unit) };
    std::vector<figures::Cell> outside;
    for (const std::optional<Detectable>& one :
      smallestDetectable(contrast, options.covers.si[i], options.ratio, kJustNoticeable))
    {
      diameters.emplace_back(one ? figures::Cell(toMillimeters(2.0 * one->nodule.radius)) : "-");
      outside.emplace_back(one ? brokenNames(contrast.rules(one->nodule)) : "-");
    }
    diameters.insert(diameters.end(), outside.begin(), outside.end());
    table.rows.push_back(std::move(diameters));
  }
  return table;
}

figures::Figure figureOf(const DetectOptions& options)
{
  figures::Figure figure{ .name = kName,
    .caption = "Smallest nodule that can be felt, " + shortest(options.ratio) +
      " times as stiff: " + describeTip(options.tissue.tip) + ", " +
      shortest(toMillimeters(options.depth)) + " mm deep",
    .bottom = "cover [mm]",
    .left = "diameter [mm]" };
  for (const JustNoticeable& difference : kJustNoticeable)
  {
    figure.curves.push_back({ .label = percentOf(difference) + " %, " + difference.name,
      .table = kName,
      .x = "cover_mm",
      .y = columnOf(difference),
      .color = static_cast<int>(figure.curves.size()) });
  }
  return figure;
}

// what the columns are, and of what
std::string headOf(const DetectOptions& options)
{
  const auto millimeters = [](double length) { return shortest(toMillimeters(length)) + " mm"; };
  const double thickness = options.geometry.geometry.thickness;
  std::string head = "# nodule " + shortest(options.ratio) +
    " times as stiff as the tissue under " + describeTip(options.tissue.tip) + ", " +
    millimeters(options.depth) + " deep; nu " + shortest(options.tissue.poisson) + ", " +
    (std::isinf(thickness) ? "half-space" : "thickness " + millimeters(thickness)) + ", law " +
    describeLaw(options.tissue.law().settings()) + "\n" +
    "# diameter from which on this differs so much from beside the nodule, pressed equally deep; "
    "-: none that fits the body, or of a radius up to 4 covers, of larger ones nothing is known\n";
  for (const JustNoticeable& difference : kJustNoticeable)
  {
    head += "# " + percentOf(difference) + " percent: " + difference.name + " (" +
      difference.source + ")\n";
  }
  return head;
}

void tellLimits(const DetectOptions& options)
{
  const Validity validity(options.tissue.law(), { .deepest = options.depth });
  const std::string broken = brokenNames(validity(placeOf(options)));
  if (!broken.empty())
  {
    std::cerr << "palp: warning: at this depth the law is outside its limits (" << broken << ")\n";
  }
}

void runDetect(const DetectOptions& options, const Renderer* pictures)
{
  constexpr int kDigits = 4;
  const bool keeps = !options.out.empty();
  const bool draws = keeps && !options.noPicture;
  if (draws && !pictures)
  {
    execProgram("palp-draw");
  }
  Outputs outputs;
  OutputFolder* output = keeps ? &outputs.open(options.out, { "detect.csv", "detect.png" },
                                   options.overwrite, { fileOf(options.tissue.tip) })
                               : nullptr;
  const std::array tables{ detect(options) };
  const std::string text = headOf(options) + figures::csv(tables[0], kDigits);
  if (keeps)
  {
    replaceFile(output->stage() / "detect.csv", text);
  }
  if (draws)
  {
    const std::array drawn{ figureOf(options) };
    pictures->drawFigures(drawn, tables, figures::Layout::Alone, output->stage());
  }
  if (keeps)
  {
    output->publish();
  }
  std::cout << text;
  tellLimits(options);
}

} // namespace

void addDetectCommand(CLI::App& app, const Renderer* pictures)
{
  auto options = std::make_shared<DetectOptions>();
  DetectOptions* all = options.get();
  CLI::App* command =
    app.add_subcommand("detect", "Tell the smallest nodule that can be felt below each cover");
  options->tissue.addMaterialTo(*command);
  options->tissue.options.addCorrectedTo(*command);
  options->geometry.addTo(*command);
  const auto add = [&](const char* name, const char* what, const char* usual, auto take)
  {
    take(usual);
    addParsed(*command, name, what, usual, take);
  };
  add("--cover", "Depths of the nodule's highest point A:B:STEP, both ends included", "2:20:2mm",
    [all](const std::string& text) { all->covers = coversOf(text); });
  add("--ratio", "Young's modulus of the nodule over that of the tissue, 0.2 to 50, no unit", "7.8",
    [all](const std::string& text) { all->ratio = ratioOf(text); });
  add("--depth", "How deep the tool presses", "5mm",
    [all](const std::string& text) {
      all->depth = parseWithin(text, Quantity::Length, { 10.0_um, 1.0, "0.01mm to 1m" }, "--depth");
    });
  command->add_option("--out", options->out, "Folder for detect.csv and detect.png");
  addOverwrite(*command, options->overwrite);
  command->add_flag("--no-picture", options->noPicture, "Write the data only");
  command->footer(
    "A nodule is noticed where, right above it and pressed as deep as beside it, the force "
    "differs\n"
    "by 7 %, stiffness by 15 % with a finger and 45 % with a stylus, or compliance, depth by "
    "force,\n"
    "by 22 %: 28.2 % more force, or 18 % less.\n"
    "outside_limits: rules of palp force --validity that it breaks.\n"
    "7.8 is a hepatocellular carcinoma in healthy liver, see palp tissues. Force and contrast\n"
    "share Young's modulus, which does not count here.\n"
    "Examples:\n"
    "  palp detect --tip sphere:10mm --cover 2:20:2mm --ratio 7.8\n"
    "  palp detect --tissue healthy_liver --thickness 40mm --depth 8mm --ratio 3 --out felt\n"
    "  palp detect --tip punch:4mm --cover 5:5:1mm --ratio 0.2            a cyst");
  command->callback([options, pictures] { runDetect(*options, pictures); });
}

} // namespace palp
