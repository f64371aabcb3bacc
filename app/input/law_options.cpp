#include "app/input/law_options.h"

#include "app/input/coating_text.h"
#include "app/input/option_values.h"
#include "app/input/quantity.h"
#include "app/program/data_files.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>

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

const std::string& nameOf(LawMode mode)
{
  return kLawModes.at(static_cast<std::size_t>(mode));
}

// what is pressed, as the corrected law takes it
void addBodyTo(CLI::App& command, LawOptions& options)
{
  addChoice(command, "--base",
    "What the body lies on, for --law corrected: bonded, slip, or unset, which is answered as "
    "bonded and flagged where a free part of the body would bend",
    kBases, options.base);
  addChoice(command, "--material", "Under large strain, for --law corrected: linear or neo-hookean",
    kMaterials, options.constitution);
}

// of a text that is wrong, and that the law would not take either, both is told
void readFor(LawMode mode, const std::function<void()>& read)
{
  try
  {
    read();
  }
  catch (const Error& error)
  {
    if (mode == LawMode::Corrected)
    {
      throw;
    }
    throw Error(error.code(),
      std::string(error.what()) + "; and take the law 'corrected', as '" + nameOf(mode) +
        "' knows none");
  }
}

} // namespace

void LawOptions::addUncoatedTo(CLI::App& command)
{
  addChoice(command, "--law",
    "paper: Eqs. (2)-(5); exact: linear half-space; corrected: every factor that acts", kLawModes,
    mode);
  addBodyTo(command, *this);
}

void LawOptions::offerCorrectedAlone(CLI::App& command)
{
  command.remove_option(command.get_option("--law"));
  addCorrectedLaw(command);
}

void LawOptions::addCorrectedTo(CLI::App& command)
{
  addCorrectedLaw(command);
  addBodyTo(command, *this);
}

void LawOptions::addCorrectedLaw(CLI::App& command)
{
  mode = LawMode::Corrected;
  addParsed(command, "--law", "corrected alone, which knows nodules", nameOf(mode),
    [](const std::string& name)
    {
      if (name != nameOf(LawMode::Corrected))
      {
        throw Error(
          ErrorCode::BadValue, "--law: only the corrected law knows nodules; leave it out");
      }
    });
}

void LawOptions::addTo(CLI::App& command)
{
  addUncoatedTo(command);
  addParsed(command, "--coating",
    "Skin, fat, a capsule on the tissue, for --law corrected: THICKNESS:YOUNG:NU from the surface "
    "down, as in 2mm:200kPa:0.45,10mm:20kPa:0.48",
    "",
    [this](const std::string& text) { readFor(mode, [&] { coatings = parseCoatings(text); }); });
  addParsed(command, "--relaxation",
    "How the modulus falls while the tissue is held, for --law corrected: FRACTION:TIME of each "
    "part of --young that decays, as in 0.3:50ms,0.2:1s",
    "",
    [this](const std::string& text)
    { readFor(mode, [&] { relaxation = parseRelaxation(text); }); });
}

void LawOptions::checkTaken(
  const std::vector<std::string>& others, const std::string& besides) const
{
  if (mode == LawMode::Corrected)
  {
    return;
  }
  std::vector<std::string> given;
  const auto add = [&](bool isAbsent, const char* option)
  { given.insert(given.end(), isAbsent ? 0 : 1, option); };
  add(coatings.empty(), "--coating");
  add(relaxation.empty(), "--relaxation");
  add(friction == 0.0, "--friction");
  given.insert(given.end(), others.begin(), others.end());
  if (given.empty())
  {
    return;
  }
  const bool isOne = given.size() == 1;
  throw Error(ErrorCode::BadValue,
    listed(given) + ": the law '" + nameOf(mode) + "' knows none" + (isOne ? "" : " of these") +
      "; take the law 'corrected'" + besides + ", or leave " + (isOne ? "it" : "them") + " out");
}

LawSettings LawOptions::settings() const
{
  const bool needed =
    constitution != ConstitutiveModel::Linear && (rated || mode == LawMode::Corrected);
  checkTaken();
  return { .mode = mode,
    .base = base,
    .constitution = constitution,
    .largeStrain = needed ? shippedTable(mode) : nullptr,
    .coatings = coatings,
    .relaxation = relaxation,
    .friction = friction };
}

PronySeries parseRelaxation(std::string_view text, std::string_view what)
{
  PronySeries series;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view one = text.substr(begin, end - begin);
    const std::size_t colon = one.find(':');
    if (colon == one.npos || end + 1 == text.size())
    {
      throw Error(ErrorCode::BadValue,
        std::string(what) + ": " + inQuotes(text) +
          " has not the form 0.3:50ms,0.2:1s (fraction of the modulus that decays, time); write it "
          "like that");
    }
    const double fraction = parseNumber(one.substr(0, colon), what);
    const double time = parseQuantity(one.substr(colon + 1), Quantity::Time, what);
    try
    {
      series.add({ fraction, time });
    }
    catch (const Error& error)
    {
      throw Error(error.code(), std::string(what) + ": " + error.what());
    }
    begin = end + 1;
  }
  return series;
}

double parseFriction(std::string_view text, std::string_view what)
{
  constexpr double kMost = 5.0; // of rubber on anything
  const double friction = parseNumber(text, what);
  if (!(friction >= 0.0 && friction <= kMost))
  {
    throw Error(ErrorCode::BadValue,
      std::string(what) + ": " + inQuotes(text) + " is out of range; give 0 to 5");
  }
  return friction;
}

std::string describeRelaxation(const PronySeries& series)
{
  std::string text;
  for (const PronyTerm& term : series.all())
  {
    text += (text.empty() ? "" : ",") + shortest(term.fraction) + ":" + shortest(term.time) + "s";
  }
  return text;
}

std::string describeLaw(const LawSettings& settings)
{
  if (settings.mode != LawMode::Corrected)
  {
    return settings.mode == LawMode::Paper ? "paper" : "exact";
  }
  return "corrected, base " + kBases.at(static_cast<std::size_t>(settings.base)) + ", " +
    (settings.constitution == ConstitutiveModel::Linear ? "linear" : "neo-hookean") +
    (settings.coatings.empty() ? "" : ", coated by " + describeCoatings(settings.coatings)) +
    (settings.relaxation.empty() ? ""
                                 : ", relaxing by " + describeRelaxation(settings.relaxation)) +
    (settings.friction > 0.0 ? ", friction " + shortest(settings.friction) : "");
}

std::string actingFactors(const ForceLaw& law, const ContactGeometry& place)
{
  std::string acting;
  for (const Factor& factor : law.factors(place))
  {
    if (const double value = std::round(factor.value * 1e4) / 1e4; value != 1.0)
    {
      addListed(acting, std::string(factor.name) + " x" + shortest(value));
    }
  }
  return acting;
}

std::string brokenNames(std::span<const Rule> rules)
{
  std::string names;
  for (const Rule& rule : rules)
  {
    if (!rule.holds())
    {
      addListed(names, rule.name);
    }
  }
  return names;
}

void GeometryOptions::addTo(CLI::App& command)
{
  const auto add = [&](const char* name, const char* what, auto parse)
  {
    addParsed(command, name, what, "",
      [this, parse](const std::string& text)
      {
        parse(text, geometry);
        given = true;
      });
  };
  add("--thickness", "Of the body under the tool, as in 30mm",
    [](const std::string& text, ContactGeometry& at)
    {
      at.thickness =
        parseWithin(text, Quantity::Length, { 0.1_mm, 1e3, "0.1mm to 1000m" }, "--thickness");
    });
  add("--surface-radius",
    "R0 of the surface, as in 50mm, -50mm where it is hollow; or R1:R2 along and across",
    [](const std::string& text, ContactGeometry& at)
    {
      const std::size_t colon = std::min(text.find(':'), text.size());
      const double along = curvature(text.substr(0, colon));
      const double across = colon < text.size() ? curvature(text.substr(colon + 1)) : along;
      at.surfaceCurvature = 0.5 * (along + across);
      at.curvatureSpread = 0.5 * std::abs(along - across);
    });
  add("--tilt", "Tool axis to surface normal, as in 9deg",
    [](const std::string& text, ContactGeometry& at) {
      at.tilt = parseWithin(text, Quantity::Angle, { 0.0, 89.0_deg, "0deg to 89deg" }, "--tilt");
    });
}

} // namespace palp
