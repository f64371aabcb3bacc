#include "app/commands/calibrate_case.h"

#include "app/input/coating_text.h"
#include "app/input/nodule_options.h"
#include "app/input/quantity.h"
#include "app/input/tip_text.h"
#include "app/stiffness/stiffness_text.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/tissue/tissue_formula.h"

#include <array>
#include <sstream>

namespace palp
{

using namespace fem;

namespace
{

constexpr double kSharpest = 0.01; // edge of a flat over its radius

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
        "--block: " + inQuotes(text) + " has fewer than three sides; give " +
          "width, length and height, as 100x100x50mm");
    }
    const bool bare = part.find_first_not_of("0123456789.") == std::string::npos;
    side = parseQuantity(bare ? part + unit : part, Quantity::Length, "--block (as 100x100x50mm)");
  }
  if (!parts.eof())
  {
    throw Error(ErrorCode::BadValue,
      "--block: " + inQuotes(text) + " has more than three sides; give three, as 100x100x50mm");
  }
  return sides;
}

Inclusion noduleOf(const std::string& text, const Material& tissue)
{
  if (text.empty())
  {
    return {};
  }
  const OffsetNodule one = parseNodule(text);
  if (one.offset > 0.0)
  {
    throw Error(ErrorCode::BadValue,
      "--nodule: " + inQuotes(text) +
        " is beside the axis, about which all is alike here; leave its distance out");
  }
  return { one.nodule.radius, one.nodule.top,
    { one.nodule.ratio * tissue.youngModulus, tissue.poissonRatio } };
}

ModulusMap mapOf(const std::string& text)
{
  if (text.empty())
  {
    return {};
  }
  const StiffnessSource source = parseStiffness(text);
  if (source.kind != StiffnessSource::Kind::Formula)
  {
    throw Error(ErrorCode::BadValue,
      "--stiffness: " + inQuotes(text) +
        " is not alike all around the axis; give formula: in r and z");
  }
  return { source.text, [formula = TissueFormula(source.text)](double radius, double depth) {
            return formula({ radius, 0.0, depth });
          } };
}

} // namespace

Case caseOf(const std::string& name, const CaseText& text)
{
  const auto value = [&](const char* key) -> const std::string& { return text.values.at(key); };
  const auto length = [&](const char* key)
  { return parseQuantity(value(key), Quantity::Length, "--" + std::string(key)); };
  const auto energy = energyNamed(value("material"));
  if (!energy)
  {
    throw Error(ErrorCode::BadValue,
      "--material: " + inQuotes(value("material")) +
        " is unknown; give linear, corotated, neo-hookean or neo-hookean-isochoric");
  }
  const std::string& model = value("model");
  if (model != "axisymmetric" && model != "block")
  {
    throw Error(ErrorCode::BadValue,
      "--model: " + inQuotes(model) + " is unknown; give axisymmetric or block");
  }
  const std::string& base = value("base");
  if (base != "bonded" && base != "slip")
  {
    throw Error(
      ErrorCode::BadValue, "--base: " + inQuotes(base) + " is unknown; give bonded or slip");
  }
  const Tip tip = parseTip(value("tip"));
  // small-strain theory knows the undeformed surface, which meets the edge of a flat at a node
  const bool sharp = *energy == StrainEnergy::Linear && flatRadius(tip) > 0.0;
  const double cap = length("cap");
  if (!sharp && cap < kSharpest * flatRadius(tip))
  {
    throw Error(ErrorCode::BadValue,
      "--cap: " + inQuotes(value("cap")) +
        " leaves the edge of a flat so sharp that large strain has no solution at it; give 1 % of "
        "its radius or more, or --material linear");
  }
  const auto [width, depth, height] = parseBlock(value("block"));
  Case study{ .name = name,
    .width = width,
    .length = depth,
    .height = height,
    .tip = sharp ? tip : withCap(tip, cap),
    .material = makeMaterial(parseQuantity(value("young"), Quantity::Pressure, "--young"),
      parseNumber(value("poisson"), "--poisson")),
    .coatings = parseCoatings(value("coating")),
    .energy = *energy,
    .depths = parseRange(value("depth"), Quantity::Length, "--depth").si,
    .threshold = length("threshold"),
    .model = model == "block" ? BodyModel::Block : BodyModel::Axisymmetric,
    .base = base == "slip" ? Base::Slip : Base::Bonded,
    .elementSize = value("element-size").empty() ? 0.0 : length("element-size") };
  study.nodule = noduleOf(value("nodule"), study.material);
  study.map = mapOf(value("stiffness"));
  if (study.depths.front() == 0.0)
  {
    study.depths.erase(study.depths.begin()); // nothing happens at first touch
  }
  check(study);
  return study;
}

} // namespace palp
