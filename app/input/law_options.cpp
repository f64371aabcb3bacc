#include "app/input/law_options.h"

#include "app/input/coating_text.h"
#include "app/input/quantity.h"
#include "app/program/data_files.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>
#include <cmath>

namespace palp
{
namespace
{

using namespace units::literals;

// 1 / R0; negative for a hollow surface
double curvature(const std::string& text)
{
  const bool hollow = text.starts_with('-');
  const Bounds bounds{ hollow ? -1e3 : 1.0_mm, hollow ? -1.0_mm : 1e3,
    "1mm to 1000m, -1mm to -1000m where it is hollow" };
  return 1.0 / parseWithin(text, Quantity::Length, bounds, "--surface-radius");
}

// the other laws need the table only to tell how far they are off, and do without
LargeStrainTable shippedTable(LawMode mode)
{
  try
  {
    return readLargeStrain(
      dataFile("tables/large_strain_sphere.csv"), dataFile("tables/large_strain_cone.csv"));
  }
  catch (const Error&)
  {
    if (mode == LawMode::Corrected)
    {
      throw;
    }
    return nullptr;
  }
}

} // namespace

void LawOptions::addTo(CLI::App& command)
{
  command
    .add_option("--law", mode,
      "paper: Eqs. (2)-(5); exact: linear half-space; corrected: every factor that acts")
    ->check(CLI::IsMember({ "paper", "exact", "corrected" }))
    ->capture_default_str();
  command.add_option("--base", base, "Under the body, for --law corrected: bonded or slip")
    ->check(CLI::IsMember({ "bonded", "slip" }))
    ->capture_default_str();
  command
    .add_option(
      "--material", constitution, "Under large strain, for --law corrected: linear or neo-hookean")
    ->check(CLI::IsMember({ "linear", "neo-hookean" }))
    ->capture_default_str();
  command.add_option("--coating", coating,
    "Skin, fat, a capsule on the tissue, for --law corrected: THICKNESS:YOUNG:NU from the surface "
    "down, as in 2mm:200kPa:0.45,10mm:20kPa:0.48");
}

LawSettings LawOptions::settings() const
{
  const ConstitutiveModel material =
    constitution == "linear" ? ConstitutiveModel::Linear : ConstitutiveModel::NeoHookean;
  const LawMode law = mode == "paper" ? LawMode::Paper
    : mode == "exact"                 ? LawMode::Exact
                                      : LawMode::Corrected;
  const bool needed = material != ConstitutiveModel::Linear && (rated || law == LawMode::Corrected);
  if (!coating.empty() && law != LawMode::Corrected)
  {
    throw Error(ErrorCode::BadValue,
      "--coating: the law '" + mode + "' knows none; take the corrected law, or leave it out");
  }
  return { .mode = law,
    .base = base == "slip" ? Base::Slip : Base::Bonded,
    .constitution = material,
    .largeStrain = needed ? shippedTable(law) : nullptr,
    .coatings = parseCoatings(coating) };
}

std::string describeLaw(const LawSettings& settings)
{
  if (settings.mode != LawMode::Corrected)
  {
    return settings.mode == LawMode::Paper ? "paper" : "exact";
  }
  return std::string("corrected, ") + (settings.base == Base::Slip ? "slip" : "bonded") +
    " base, " + (settings.constitution == ConstitutiveModel::Linear ? "linear" : "neo-hookean") +
    (settings.coatings.empty() ? "" : ", coated by " + describeCoatings(settings.coatings));
}

std::string brokenNames(const Rules& rules)
{
  std::string names;
  for (const Rule& rule : rules)
  {
    if (!rule.holds())
    {
      names += (names.empty() ? "" : ", ") + std::string(rule.name);
    }
  }
  return names;
}

void PlaceOptions::addTo(CLI::App& command)
{
  command.add_option("--thickness", thickness, "Of the body under the tool, as in 30mm");
  command.add_option("--surface-radius", surfaceRadius,
    "R0 of the surface, as in 50mm, -50mm where it is hollow; or R1:R2 along and across");
  command.add_option("--tilt", tilt, "Tool axis to surface normal, as in 9deg");
}

ContactGeometry PlaceOptions::place() const
{
  ContactGeometry place;
  if (!thickness.empty())
  {
    place.thickness =
      parseWithin(thickness, Quantity::Length, { 0.1_mm, 1e3, "0.1mm to 1000m" }, "--thickness");
  }
  if (!surfaceRadius.empty())
  {
    const std::size_t colon = std::min(surfaceRadius.find(':'), surfaceRadius.size());
    const double along = curvature(surfaceRadius.substr(0, colon));
    const double across =
      colon < surfaceRadius.size() ? curvature(surfaceRadius.substr(colon + 1)) : along;
    place.surfaceCurvature = 0.5 * (along + across);
    place.curvatureSpread = 0.5 * std::abs(along - across);
  }
  if (!tilt.empty())
  {
    place.tilt = parseWithin(tilt, Quantity::Angle, { 0.0, 89.0_deg, "0deg to 89deg" }, "--tilt");
  }
  return place;
}

} // namespace palp
