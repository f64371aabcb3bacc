#include "app/stiffness/stiffness_text.h"

#include "app/input/mesh_file.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/quantity.h"
#include "app/input/tissue_presets.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cctype>
#include <utility>

namespace palp
{
namespace
{

using Kind = StiffnessSource::Kind;

constexpr std::array kKinds{ "", "labels", "image", "array", "formula", "random" };

[[noreturn]] void refuseForm(std::string_view text, std::string_view what)
{
  throw Error(ErrorCode::BadValue,
    std::string(what) + ": " + inQuotes(text) +
      " has none of the forms labels:FILE:1=healthy_liver,2=40kPa, image:FILE, array:FILE:NAME, "
      "formula:6+0.1*z, random:0.3:8mm:SEED; write it like one of them");
}

// before and behind the last colon
std::pair<std::string_view, std::string_view> halves(std::string_view text, std::string_view what)
{
  const std::size_t colon = text.rfind(':');
  if (colon == text.npos || colon == 0 || colon + 1 == text.size())
  {
    refuseForm(text, what);
  }
  return { text.substr(0, colon), text.substr(colon + 1) };
}

// of a measured tissue, or a modulus
double youngOf(std::string_view text, std::string_view what)
{
  if (!text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) != 0)
  {
    return parseWithin(text, Quantity::Pressure, { 1.0, 1e10, "1Pa to 10GPa" }, what);
  }
  const std::vector<TissuePreset> tissues = shippedTissues();
  return tissueNamed(text, tissues, what).material.youngModulus;
}

std::vector<LabelModulus> labelsOf(std::string_view text, std::string_view what)
{
  std::vector<LabelModulus> labels;
  for (const std::string_view one : split(text, ','))
  {
    const std::size_t equals = one.find('=');
    if (equals == one.npos || equals == 0)
    {
      refuseForm(text, what);
    }
    const std::string label(one.substr(0, equals));
    if (std::ranges::find(labels, label, &LabelModulus::label) != labels.end())
    {
      throw Error(ErrorCode::BadValue,
        std::string(what) + ": the label " + inQuotes(label) + " is given twice; give it once");
    }
    labels.push_back({ label, youngOf(one.substr(equals + 1), what) });
  }
  return labels;
}

RandomTissue randomOf(std::string_view text, std::string_view what)
{
  const std::vector<std::string_view> fields = split(text, ':');
  if (fields.size() != 2 && fields.size() != 3)
  {
    refuseForm(text, what);
  }
  RandomTissue random;
  random.spread = parseNumber(fields[0], what);
  if (!(random.spread > 0.0 && random.spread <= 1.0))
  {
    throw Error(ErrorCode::BadValue,
      std::string(what) + ": a spread of " + shortest(random.spread) +
        " is out of range; give above 0, to 1, of the mean");
  }
  random.length = parseWithin(fields[1], Quantity::Length, { 1e-3, 0.1, "1mm to 100mm" }, what);
  if (fields.size() == 3)
  {
    const double seed = parseNumber(fields[2], what);
    random.seed = static_cast<std::uint32_t>(std::clamp(seed, 0.0, 4294967295.0));
    if (static_cast<double>(random.seed) != seed)
    {
      throw Error(ErrorCode::BadValue,
        std::string(what) + ": the seed is no whole number from 0 to 4294967295; give one");
    }
  }
  return random;
}

} // namespace

StiffnessSource parseStiffness(std::string_view text, std::string_view what)
{
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto* kind = std::ranges::find(kKinds, text.substr(0, colon));
  if (kind == kKinds.end() || colon + 1 >= text.size())
  {
    refuseForm(text, what);
  }
  StiffnessSource source{ .kind = static_cast<Kind>(kind - kKinds.begin()) };
  const std::string_view rest = text.substr(colon + 1);
  switch (source.kind)
  {
    case Kind::Labels:
      source.file = halves(rest, what).first;
      source.labels = labelsOf(halves(rest, what).second, what);
      break;
    case Kind::Image:
      source.file = rest;
      break;
    case Kind::Array:
      source.file = halves(rest, what).first;
      source.text = halves(rest, what).second;
      break;
    case Kind::Formula:
      source.text = rest;
      break;
    case Kind::Random:
      source.random = randomOf(rest, what);
      break;
    case Kind::None:
      refuseForm(text, what);
  }
  return source;
}

std::string describeStiffness(const StiffnessSource& source, const std::string& file)
{
  const std::string kind = std::string(kKinds.at(static_cast<std::size_t>(source.kind))) + ':';
  switch (source.kind)
  {
    case Kind::Labels:
    {
      std::string labels;
      for (const auto& [label, young] : source.labels)
      {
        labels +=
          (labels.empty() ? "" : ",") + label + '=' + quantityText(young, Quantity::Pressure);
      }
      return kind + file + ':' + labels;
    }
    case Kind::Image:
      return kind + file;
    case Kind::Array:
      return kind + file + ':' + source.text;
    case Kind::Formula:
      return kind + source.text;
    case Kind::Random:
      return kind + shortest(source.random.spread) + ':' +
        quantityText(source.random.length, Quantity::Length) + ':' +
        std::to_string(source.random.seed);
    case Kind::None:
      break;
  }
  return "";
}

std::string identityOf(const StiffnessSource& source)
{
  return describeStiffness(
    source, source.file.empty() ? "" : "SHA-256 " + describeFile(source.file).sha256);
}

void checkStiffness(
  const StiffnessSource& named, const std::filesystem::path& organ, const std::string& described)
{
  if (identityOf(named) != described)
  {
    throw Error(ErrorCode::BadFile,
      printable(organ.string()) + ": is of a body " +
        (described.empty() ? "of one modulus; leave out --stiffness, or make it again with it"
                           : "whose stiffness is " + described +
              "; give the same --stiffness, or make it again with another one") +
        ", by palp organ");
  }
}

std::string mapRefusal(const MeshSource& mesh, const LawOptions& law)
{
  if (!mesh.stiffness.isGiven())
  {
    return "";
  }
  if (law.mode != LawMode::Corrected || !law.coatings.empty())
  {
    return "a map takes the law 'corrected' and no coating; give these, or leave the map out";
  }
  return mesh.nodules.empty()
    ? ""
    : "nodules in a body with a map are not known; give them as labels of it, or leave one out";
}

void checkMap(const MeshSource& mesh, const LawOptions& law)
{
  mesh.stiffness.isGiven() ? law.checkTaken({ "--stiffness" }) : void();
  if (const std::string other = mapRefusal(mesh, law); !other.empty())
  {
    throw Error(ErrorCode::BadValue, "--stiffness: " + other);
  }
}

void addStiffness(CLI::App& command, StiffnessSource& source)
{
  addParsed(command, "--stiffness",
    "Young's modulus that differs from place to place, for --law corrected: "
    "labels:FILE:1=healthy_liver,2=40kPa (regions of a label map), image:FILE (kPa, as of "
    "elastography), array:FILE.vtp:NAME (kPa, of a surface), formula:6+0.1*z (kPa, of x, y, z, r "
    "in mm), random:0.3:8mm:7 (spread over the mean, length, seed; about --young)",
    "", [&source](const std::string& text) { source = parseStiffness(text); });
}

} // namespace palp
