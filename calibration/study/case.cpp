#include "calibration/study/case.h"

#include "haptics/error.h"
#include "haptics/numerics/roots.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp::fem
{
namespace
{

using namespace units::literals;

constexpr double kElementSize = 0.5_mm;
constexpr int kPaperNodes = 30; // along a side, Sec. 4.3
constexpr int kPaperLayers = 10;
// halving the elements changes the force at 1 to 5 mm by 0.5 % at 25
// degrees, 1.5 % at 20, 6 % at 15
constexpr double kSharpest = 25.0_deg - 1e-9;
constexpr double kRefined = 0.2;   // smallest element to the largest under the tool
constexpr double kRounding = 0.06; // of the edge of a flat, at most, over its radius
constexpr double kDraft = 5.0_deg; // of a punch's side, so that its height follows from the radius
constexpr double kCoarse = 0.1;    // distance of nodes under the tool, over its radius

void require(bool good, const std::string& what)
{
  if (!good)
  {
    throw Error(ErrorCode::BadValue, what);
  }
}

double equalAreaRadius(const Case& study)
{
  return std::sqrt(study.width * study.length / std::numbers::pi);
}

// in the volumetric block, whose number of elements is given, wider ones than evenly spaced under
// the tool would overshoot its side
double largestElement(const Case& study)
{
  const double ofHeight = 0.2 * study.height;
  return study.model == BodyModel::Block ? std::min(ofHeight, study.width / (kPaperNodes - 1))
                                         : ofHeight;
}

bool isRound(const Tip& tip)
{
  return std::holds_alternative<SphereTip>(tip) || std::holds_alternative<ParaboloidTip>(tip);
}

// at the edge of a flat the pressure has no bound
Refinement refinementOf(const Case& study)
{
  if (flatRadius(study.tip) == 0.0)
  {
    return {};
  }
  return { .radius = flatRadius(study.tip), .size = kRefined * elementSize(study) };
}

// a flat, a round edge and a straight flank up to a height
Tip rounded(const std::string& name, double flat, double rounding, double halfAngle, double height)
{
  constexpr int kPoints = 30; // on the edge
  const double turn = 90.0_deg - halfAngle;
  std::vector<Profile::Point> points{ { .radius = 0.0, .height = 0.0 } };
  for (int i = 0; i <= kPoints; ++i)
  {
    const double angle = turn * i / kPoints;
    points.push_back({ .radius = flat + rounding * std::sin(angle),
      .height = rounding * (1.0 - std::cos(angle)) });
  }
  const Profile::Point end = points.back();
  for (const double fraction :
    { 0.01, 0.02, 1.0 }) // straight also where the edge's curve would go on
  {
    const double rise = fraction * (height - end.height);
    points.push_back(
      { .radius = end.radius + rise * std::tan(halfAngle), .height = end.height + rise });
  }
  return ProfileTip{ std::make_shared<const Profile>(
    std::move(points), name + ", edge rounded by " + units::inMillimeters(rounding)) };
}

void checkNodule(const Case& study)
{
  const auto& [radius, top, material] = study.nodule;
  require(study.model == BodyModel::Axisymmetric && study.coatings.empty(),
    "--nodule: taken by --model axisymmetric without --coating only; leave one of them out");
  using units::inMillimeters;
  const double least = 2.0 * elementSize(study);
  const std::string elements = "two elements of " + inMillimeters(0.5 * least);
  require(radius >= least,
    "--nodule: its radius of " + inMillimeters(radius) + " is less than " + elements +
      "; give a larger one, or a smaller --element-size");
  require(top >= least,
    "--nodule: its highest point, " + inMillimeters(top) + " deep, is less than " + elements +
      " below the surface; give it deeper, or a smaller --element-size");
  const double bottom = top + 2.0 * radius;
  const double halfWidth = 0.5 * std::min(study.width, study.length);
  require(study.height - bottom >= least && 2.0 * radius < halfWidth,
    "--nodule: it reaches from " + inMillimeters(top) + " to " + inMillimeters(bottom) +
      " deep and is " + inMillimeters(2.0 * radius) + " wide, and this block takes one to " +
      inMillimeters(study.height - least) + " deep, " + elements +
      " above its base, and less than half as wide as it, " + inMillimeters(halfWidth) +
      "; give a smaller nodule, or a larger --block");
}

void checkMap(const Case& study)
{
  require(
    study.model == BodyModel::Axisymmetric && study.coatings.empty() && study.nodule.radius == 0.0,
    "--stiffness: taken by --model axisymmetric without --coating and --nodule; leave them out");
}

// that of the middle of each element
void applyMap(Body& body, const Case& study)
{
  for (Element& element : body.elements)
  {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const int dof : element.dofs)
    {
      middle[dof % 2] += body.positions(dof % 2, dof / 2);
    }
    middle *= 2.0 / static_cast<double>(element.dofs.size());
    element.material = Material{ study.map.young(middle.x(), study.height - middle.y()),
      study.material.poissonRatio };
  }
}

} // namespace

double contactReach(const Tip& tip, double depth)
{
  const auto isLower = [&](double radius) { return tipHeight(tip, radius) < depth; };
  return bisect(isLower, { 0.0, baseRadius(tip) }, 60).high;
}

double elementSize(const Case& study)
{
  if (study.elementSize > 0.0)
  {
    return study.elementSize;
  }
  return study.model == BodyModel::Block
    ? std::min(kCoarse * baseRadius(study.tip), largestElement(study))
    : kElementSize;
}

Tip withCap(const Tip& tip, double cap)
{
  if (cap == 0.0)
  {
    return tip;
  }
  if (const auto* cone = std::get_if<ConeTip>(&tip))
  {
    return checkedTip(BluntConeTip{
      .halfAngle = cone->halfAngle, .tipRadius = cap, .baseRadius = cone->baseRadius });
  }
  if (const auto* punch = std::get_if<PunchTip>(&tip))
  {
    const double rounding = std::min(cap, kRounding * punch->radius);
    return rounded(
      "flat punch of " + units::inMillimeters(punch->radius) + ", sides inclined by 5 degrees",
      punch->radius - rounding, rounding, kDraft, 2.0 * punch->radius);
  }
  if (const auto* cone = std::get_if<TruncatedConeTip>(&tip))
  {
    const double rounding = std::min(cap, kRounding * cone->flatRadius);
    const double tangent = rounding * std::tan(0.5 * (90.0_deg - cone->halfAngle));
    return rounded("cone cut off at " + units::inMillimeters(cone->flatRadius),
      cone->flatRadius - tangent, rounding, cone->halfAngle,
      (cone->baseRadius - cone->flatRadius) / std::tan(cone->halfAngle));
  }
  return tip;
}

void check(const Case& study)
{
  (void)checkedTip(study.tip);
  (void)makeMaterial(study.material.youngModulus, study.material.poissonRatio);
  const auto* cone = std::get_if<ConeTip>(&study.tip);
  const auto* blunt = std::get_if<BluntConeTip>(&study.tip);
  const double angle = cone ? cone->halfAngle : blunt ? blunt->halfAngle : 90.0_deg;
  require(study.energy == StrainEnergy::Linear || angle >= kSharpest,
    "--tip: under a cone of less than 25 degrees no mesh follows the surface; give 25 degrees or "
    "more, or --material linear");
  require(study.width > 0.0 && study.length > 0.0 && study.height > 0.0,
    "--block: a side of the block is not positive; give it as 100x100x50mm");
  require(!study.depths.empty() && study.depths.front() > 0.0 &&
      std::adjacent_find(study.depths.begin(), study.depths.end(),
        [](double a, double b) { return !(b > a); }) == study.depths.end(),
    "--depth: the depths must be positive and increase; give them as 0.5:10:0.5mm");
  const double deepest = study.depths.back();
  require(baseRadius(study.tip) < 0.45 * std::min(study.width, study.length),
    "--tip: the tool is larger than the block; its radius must stay below " +
      units::inMillimeters(0.45 * std::min(study.width, study.length)));
  require(deepest < 0.8 * study.height,
    "--depth: " + units::inMillimeters(deepest) + " goes through the block; stay below " +
      units::inMillimeters(0.8 * study.height));
  require(study.threshold > 0.0 && study.threshold < deepest,
    "--threshold: must be positive and less than the deepest depth of " +
      units::inMillimeters(deepest));
  require(study.elementSize == 0.0 ||
      (study.elementSize >= kSmallestElement && study.elementSize <= largestElement(study)),
    "--element-size: must be between 0.01 mm and " + units::inMillimeters(largestElement(study)) +
      " in this block");
  require(study.model == BodyModel::Axisymmetric || study.width == study.length,
    "--model: the volumetric block must be square; use --model axisymmetric");
  require(study.base != Base::Slip || study.model == BodyModel::Axisymmetric,
    "--base: the volumetric block is bonded; use --model axisymmetric");
  require(study.coatings.empty() || study.model == BodyModel::Axisymmetric,
    "--coating: the volumetric block takes none; use --model axisymmetric");
  require(study.coatings.thickness() < study.height,
    "--coating: as thick as the block of " + units::inMillimeters(study.height) + "; give less");
  for (const Coating& coating : study.coatings.all())
  {
    require(coating.material.poissonRatio < 0.5,
      "--coating: finite elements need a Poisson's ratio of less than 0.5; give 0.49");
    require(coating.thickness >= elementSize(study),
      "--coating: thinner than an element; give --element-size " +
        units::inMillimeters(coating.thickness) + " or less");
  }
  if (study.nodule.radius > 0.0)
  {
    checkNodule(study);
  }
  if (study.map.young)
  {
    checkMap(study);
  }
  require(
    study.material.poissonRatio < 0.5, "--poisson: finite elements need less than 0.5; give 0.49");
}

Body bodyOf(const Case& study)
{
  const double size = elementSize(study);
  if (study.model == BodyModel::Axisymmetric)
  {
    const double fine = 1.05 * contactReach(study.tip, study.depths.back()) + 2.0 * size;
    Body body = cylinderBody(equalAreaRadius(study), study.height, fine, size, study.coatings,
      isRound(study.tip) ? Integration::Reduced : Integration::Full, study.base,
      refinementOf(study), study.nodule);
    study.map.young ? applyMap(body, study) : void();
    return body;
  }
  return blockBody(study.width, study.height, kPaperNodes, kPaperLayers, size);
}

} // namespace palp::fem
