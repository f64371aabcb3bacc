#include "app/commands/commands.h"
#include "app/commands/pressed_place.h"
#include "app/input/law_options.h"
#include "app/input/nodule_options.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/quantity.h"
#include "app/press/force_history.h"
#include "app/stiffness/stiffness_text.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/force/inclination.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"
#include "pipeline/tissue/tissue_formula.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palp
{
namespace
{

constexpr double kLargestDepth = 1.0;  // [m]; no organ is deeper
constexpr double kLeastDeepest = 1e-6; // [m]; for which tables are made

struct ForceOptions
{
  TissueOptions tissue;
  GeometryOptions geometry;
  NoduleOptions nodules;
  StiffnessSource stiffness;
  Range depths;
  std::filesystem::path history; // of depths over time, in place of depths
  bool validity = false;
};

// which factors act, for people, on standard error
void tellFactors(const ForceLaw& law, const ContactGeometry& deepest)
{
  const std::string acting = actingFactors(law, deepest);
  std::cerr << "palp: factors at the largest depth: " << (acting.empty() ? "none acts" : acting)
            << '\n';
  if (law.settings().mode == LawMode::Corrected &&
    law.settings().constitution == ConstitutiveModel::NeoHookean &&
    !law.largeStrain(deepest).inside)
  {
    std::cerr << (law.settings().coatings.empty()
        ? "palp: this tool and place are outside what finite elements of large strain were made "
          "for\n"
        : "palp: coated tissue counts as linear at large strain\n");
  }
}

// that of coatings only where there are some
std::span<const Factor> factorsOf(const ForceLaw& law, const Factors& factors)
{
  return std::span(factors).first(factors.size() - (law.settings().coatings.empty() ? 1 : 0));
}

Range depthsOf(const std::string& text)
{
  Range depths = parseRange(text, Quantity::Length, "--depth");
  if (depths.si.front() < 0.0 || depths.si.back() > kLargestDepth)
  {
    throw Error(ErrorCode::BadValue, "--depth: '" + text + "' is out of range; give 0mm to 1m");
  }
  return depths;
}

bool isPaper(const ForceLaw& law)
{
  return law.settings().mode == LawMode::Paper;
}

// what the columns are
void printHead(
  const PressedPlace& pressed, const ContactGeometry& geometry, std::span<const Rule> rules)
{
  std::string header = "depth_mm,force_N,contact_radius_mm,stiffness_N_per_mm";
  if (!isPaper(pressed.law))
  {
    for (const Factors factors = pressed.law.factors(geometry);
         const Factor& factor : factorsOf(pressed.law, factors))
    {
      header += ",factor_" + std::string(factor.name);
    }
    header += (pressed.nodules        ? ",factor_nodules"
                  : pressed.stiffness ? ",factor_stiffness"
                                      : "") +
      std::string(",axial_force_N,lateral_force_N");
  }
  for (const Rule& rule : rules)
  {
    std::cout << "# " << rule.name << "_of_limit: " << rule.why << '\n';
    header += "," + std::string(rule.name) + "_of_limit";
  }
  std::cout << header << '\n';
}

// after the depth
void addForces(
  std::vector<double>& row, const PressedPlace& pressed, const ContactGeometry& geometry)
{
  const auto& [law, nodules, stiffness, validity] = pressed;
  const Response response = pressed.response(geometry);
  row.insert(row.end(),
    { response.force, units::toMillimeters(response.contactRadius),
      units::toNewtonsPerMillimeter(response.stiffness) });
  if (!isPaper(law))
  {
    for (const Factors factors = law.factors(geometry);
         const Factor& factor : factorsOf(law, factors))
    {
      row.push_back(factor.value);
    }
    if (nodules || stiffness)
    {
      const double plain = law(geometry).force;
      row.push_back(plain > 0.0 ? response.force / plain : 1.0);
    }
    const InclinedForce felt = inclinedForce(response.force, geometry.tilt);
    row.insert(row.end(), { felt.axial, felt.lateral + pressed.aside(geometry).x() });
  }
}

// what else there is to know of the largest depth, on standard error
void tellLimits(
  const ForceLaw& law, std::span<const Rule> rules, const ContactGeometry& deepest, bool given)
{
  if (!isPaper(law))
  {
    tellFactors(law, deepest);
  }
  if (const std::string broken = brokenNames(rules); !broken.empty())
  {
    std::cerr << "palp: warning: at the largest depth the law is outside its limits (" << broken
              << "); --validity tells how far at each\n";
  }
  if (given && law.settings().mode != LawMode::Corrected)
  {
    std::cerr << "palp: thickness, surface and tilt change the force with --law corrected only\n";
  }
}

// what of a map's push the column of the lateral force leaves out, on standard error
void tellAside(const PressedPlace& pressed, const ContactGeometry& deepest)
{
  constexpr double kFelt = 0.01; // of the force
  const double across = pressed.aside(deepest).y();
  if (std::abs(across) > kFelt * pressed.response(deepest).force)
  {
    std::cerr << "palp: lateral_force_N is along x; at the largest depth the map pushes by "
              << shortest(across) << " N along y, too\n";
  }
}

// by a formula, in the frame of the tool
std::shared_ptr<const StiffnessField> stiffnessBelow(
  const ForceOptions& options, const ForceLaw& law, double deepest)
{
  const StiffnessSource& source = options.stiffness;
  if (!source.isGiven())
  {
    return nullptr;
  }
  if (source.kind != StiffnessSource::Kind::Formula)
  {
    throw Error(ErrorCode::BadValue,
      "--stiffness: there is no body here whose map it could be; give formula:..., z being below "
      "the surface, or press a body by palp run");
  }
  if (!options.nodules.nodules.empty())
  {
    throw Error(ErrorCode::BadValue,
      "--stiffness: not known together with --nodule; write the nodule into the formula, or leave "
      "one out");
  }
  checkMap({ .stiffness = source }, options.tissue.options);
  return stiffnessUnder(law, options.geometry.geometry, deepest, TissueFormula(source.text));
}

// what is pressed, as deep as it will be
PressedPlace pressedBy(const ForceOptions& options, double deepest)
{
  const ForceLaw law = options.tissue.law();
  const ContactGeometry& geometry = options.geometry.geometry;
  law.checkBody(geometry.thickness);
  return { .law = law,
    .nodules = options.nodules.under(law, geometry, deepest),
    .stiffness = stiffnessBelow(options, law, deepest),
    .validity = Validity(law, { .deepest = deepest }) };
}

void printForces(const ForceOptions& options)
{
  const Range& depths = options.depths;
  ContactGeometry geometry = options.geometry.geometry;
  const PressedPlace pressed = pressedBy(options, depths.si.back());
  const std::vector<Rule> rules = pressed.rules(geometry);
  printHead(pressed, geometry, std::span(rules).first(options.validity ? rules.size() : 0));

  std::vector<double> row;
  for (std::size_t i = 0; i < depths.si.size(); ++i)
  {
    geometry.depth = depths.si[i];
    row = { depths.given[i] * units::toMillimeters(depths.unit) };
    addForces(row, pressed, geometry);
    if (options.validity)
    {
      for (const Rule& rule : pressed.rules(geometry))
      {
        row.push_back(rule.fraction());
      }
    }
    writeCsvRow(std::cout, row);
  }
  tellLimits(pressed.law, pressed.rules(geometry), geometry, options.geometry.given);
  tellAside(pressed, geometry);
}

// force over time of a press that was given
void printHistory(const ForceOptions& options)
{
  const ForceHistory history = readForceHistory(options.history);
  ContactGeometry geometry = options.geometry.geometry;
  const PressedPlace pressed = pressedBy(options, std::max(history.deepest(), kLeastDeepest));
  const auto elastic = [&](double depth)
  {
    geometry.depth = depth;
    const Response at = pressed.response(geometry);
    return ElasticForce{ at.force, at.stiffness };
  };
  std::cout << "time_s,depth_mm,force_N\n";
  std::size_t i = 0;
  for (const double force : forcesOver(elastic, pressed.law.settings().relaxation, history))
  {
    writeCsvRow(std::cout, std::array{ history.points[i].time, history.depthsMm[i], force });
    ++i;
  }
  geometry.depth = std::max(0.0, history.deepest());
  tellLimits(pressed.law, pressed.rules(geometry), geometry, options.geometry.given);
}

// what does not go with the law, or needs more, all at once
void checkGiven(const ForceOptions& options)
{
  const std::string history = "--history FILE.csv with columns time_s and depth_mm";
  const bool isTimeless = options.history.empty() && !options.tissue.options.relaxation.empty();
  std::vector<std::string> others(options.nodules.nodules.empty() ? 0 : 1, "--nodule");
  others.insert(others.end(), options.stiffness.isGiven() ? 1 : 0, "--stiffness");
  options.tissue.options.checkTaken(
    others, isTimeless ? " and, to relax over time, " + history : "");
  if (isTimeless)
  {
    throw Error(
      ErrorCode::BadValue, "--relaxation: acts over time; add " + history + ", or leave it out");
  }
}

void force(const ForceOptions& options, Work work)
{
  checkGiven(options);
  if (work == Work::Check)
  {
    return (void)pressedBy(options, options.depths.si.back());
  }
  options.history.empty() ? printForces(options) : printHistory(options);
}

} // namespace

void addForceCommand(CLI::App& app, Work work)
{
  auto options = std::make_shared<ForceOptions>();
  CLI::App* command = app.add_subcommand("force", "Print the force law as CSV");
  options->tissue.addTo(*command);
  options->geometry.addTo(*command);
  options->nodules.addTo(*command);
  addStiffness(*command, options->stiffness);
  const std::string usual = "0:10:0.5mm";
  options->depths = depthsOf(usual);
  CLI::Option* depth =
    addParsed(*command, "--depth", "Indentation depths A:B:STEP, both ends included", usual,
      [options = options.get()](const std::string& text) { options->depths = depthsOf(text); });
  CLI::Option* validity = command->add_flag("--validity", options->validity,
    "Append for each condition of the law how much of its limit is used; above 1 it is broken");
  command
    ->add_option("--history", options->history,
      "CSV time_s,depth_mm of a press, or an exported samples.csv: the force at each of its times, "
      "for --relaxation")
    ->excludes(depth)
    ->excludes(validity);
  command->footer(
    "Examples:\n"
    "  palp force --tip cone:45deg:10mm --young 50kPa --poisson 0.33 --depth 0:10:0.5mm\n"
    "  palp force --tip sphere:6mm --law corrected --thickness 30mm --surface-radius 50mm\n"
    "  palp force --tip profile:tip.csv --law exact --validity\n"
    "  palp force --young 5kPa --poisson 0.45 --law corrected --coating 2mm:50kPa:0.45\n"
    "  palp force --young 5kPa --law corrected --relaxation 0.3:50ms,0.2:1s --history press.csv\n"
    "  palp force --law corrected --thickness 40mm --nodule 5mm:5mm:10:8mm\n"
    "  palp force --law corrected --thickness 40mm --stiffness 'formula:if(z<2,150,50)'");
  command->callback([options, work] { force(*options, work); });
}

} // namespace palp
