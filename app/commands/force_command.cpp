#include "app/commands/commands.h"
#include "app/input/law_options.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/quantity.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/force/inclination.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

namespace palp
{
namespace
{

constexpr double kLargestDepth = 1.0; // [m]; no organ is deeper

struct ForceOptions
{
  TissueOptions tissue;
  GeometryOptions geometry;
  Range depths;
  bool validity = false;
};

// which factors act, for people, on standard error
void tellFactors(const ForceLaw& law, const ContactGeometry& deepest)
{
  std::string acting;
  for (const Factor& factor : law.factors(deepest))
  {
    if (const double value = std::round(factor.value * 1e4) / 1e4; value != 1.0)
    {
      acting += (acting.empty() ? "" : ", ") + std::string(factor.name) + " x" + shortest(value);
    }
  }
  std::cerr << "palp: factors at the largest depth: " << (acting.empty() ? "none acts" : acting)
            << '\n';
  const bool bare = law.settings().mode == LawMode::Corrected &&
    law.settings().constitution == ConstitutiveModel::NeoHookean &&
    !law.largeStrain(deepest).inside;
  if (bare)
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
void printHead(const ForceLaw& law, const ContactGeometry& geometry, std::span<const Rule> rules)
{
  std::string header = "depth_mm,force_N,contact_radius_mm,stiffness_N_per_mm";
  if (!isPaper(law))
  {
    for (const Factors factors = law.factors(geometry);
         const Factor& factor : factorsOf(law, factors))
    {
      header += ",factor_" + std::string(factor.name);
    }
    header += ",axial_force_N,lateral_force_N";
  }
  for (const Rule& rule : rules)
  {
    std::cout << "# " << rule.name << "_of_limit: " << rule.why << '\n';
    header += "," + std::string(rule.name) + "_of_limit";
  }
  std::cout << header << '\n';
}

// after the depth
void addForces(std::vector<double>& row, const ForceLaw& law, const ContactGeometry& geometry)
{
  const Response response = law(geometry);
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
    const InclinedForce felt = inclinedForce(response.force, geometry.tilt);
    row.insert(row.end(), { felt.axial, felt.lateral });
  }
}

void printForces(const ForceOptions& options)
{
  const ForceLaw law = options.tissue.law();
  const Range& depths = options.depths;
  ContactGeometry geometry = options.geometry.geometry;
  const Validity validity(law, { .deepest = depths.si.back() });
  const Rules rules = validity(geometry);
  printHead(law, geometry, std::span(rules).first(options.validity ? rules.size() : 0));

  std::vector<double> row;
  for (std::size_t i = 0; i < depths.si.size(); ++i)
  {
    geometry.depth = depths.si[i];
    row = { depths.given[i] * units::toMillimeters(depths.unit) };
    addForces(row, law, geometry);
    if (options.validity)
    {
      for (const Rule& rule : validity(geometry))
      {
        row.push_back(rule.fraction());
      }
    }
    writeCsvRow(std::cout, row);
  }
  if (!isPaper(law))
  {
    tellFactors(law, geometry);
  }
  if (const std::string broken = brokenNames(validity(geometry)); !broken.empty())
  {
    std::cerr << "palp: warning: at the largest depth the law is outside its limits (" << broken
              << "); --validity tells how far at each\n";
  }
  if (options.geometry.given && law.settings().mode != LawMode::Corrected)
  {
    std::cerr << "palp: thickness, surface and tilt change the force with --law corrected only\n";
  }
}

} // namespace

void addForceCommand(CLI::App& app)
{
  auto options = std::make_shared<ForceOptions>();
  CLI::App* command = app.add_subcommand("force", "Print the force law as CSV");
  options->tissue.addTo(*command);
  options->geometry.addTo(*command);
  const std::string usual = "0:10:0.5mm";
  options->depths = depthsOf(usual);
  addParsed(*command, "--depth", "Indentation depths A:B:STEP, both ends included", usual,
    [options = options.get()](const std::string& text) { options->depths = depthsOf(text); });
  command->add_flag("--validity", options->validity,
    "Append for each condition of the law how much of its limit is used; above 1 it is broken");
  command->footer(
    "Examples:\n"
    "  palp force --tip cone:45deg:10mm --young 50kPa --poisson 0.33 --depth 0:10:0.5mm\n"
    "  palp force --tip sphere:6mm --law corrected --thickness 30mm --surface-radius 50mm\n"
    "  palp force --tip profile:tip.csv --law exact --validity\n"
    "  palp force --young 5kPa --poisson 0.45 --law corrected --coating 2mm:50kPa:0.45");
  command->callback([options] { printForces(*options); });
}

} // namespace palp
