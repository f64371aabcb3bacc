#include "haptics/force/validity.h"

#include "haptics/force/ellipse.h"
#include "haptics/force/inclination.h"
#include "haptics/force/linear/coated_body.h"
#include "haptics/force/linear/layer_contact.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kPaperDepth = 3.3 / 6.0;     // depth / R, Sec. 4.3
constexpr double kPaperCurvature = 1.0 / 3.0; // R / R0, Sec. 3.2
constexpr double kHollow = 0.5;               // R / R0 to which a hollow surface is corrected
constexpr double kVerifiedWidth = 0.6;        // a / thickness to which the layer is verified
constexpr double kEdge = 0.2;                 // a / distance, at 90 degrees: 7 % (elements)
constexpr double kBend = 0.15;                // [rad] of the normals below the tool, rms
constexpr double kFlatOnCurved = 0.05;        // [-] of the force
constexpr double kSupport = 0.08;             // a / R0 of a ball: 5 % from support to support
constexpr double kAboveHollow = 0.02;         // part of the contact
constexpr double kComparedDepth = 0.5;        // depth / thickness that was compared
constexpr double kLinearError = 0.03;         // of neo-Hookean elements
constexpr double kConeTilt = 9.0_deg;         // Sec. 3.2, at a half angle of 45 degrees
constexpr double kDirection = 32.0_deg;       // just noticeable, Sec. 3.2

// Depth to which a stiff coating does not stretch as a membrane [m]: five times as stiff, it adds 3
// to 8 % once pressed deeper than it is thick, 20 % later; as a capsule 1.2 % at most (0.2 mm, 20
// times as stiff, a ball of 10 mm 4 mm deep; neo-Hookean elements).
double membraneReach(const ForceLaw& law)
{
  constexpr double membrane = 5.0;
  constexpr double capsule = 0.4; // [-] thickness over the tip's radius, times as stiff
  double reach = std::numeric_limits<double>::infinity();
  const auto sheets = law.settings().coatings.all();
  for (auto sheet = sheets.begin(); sheet != sheets.end(); ++sheet)
  {
    double thickness = 0.0; // down to something soft
    for (auto below = sheet; below != sheets.end(); ++below)
    {
      thickness += below->thickness;
      const Material& next = below + 1 != sheets.end() ? below[1].material : law.material();
      const double stiffer = sheet->material.contactModulus() / next.contactModulus();
      if (stiffer > membrane)
      {
        const bool isCapsule = stiffer * thickness <= capsule * baseRadius(law.tip());
        reach = isCapsule ? reach : std::min(reach, thickness);
        break;
      }
    }
  }
  return reach;
}

// how far, at most, a linear law is from neo-Hookean elements on a half-space
double errorOfLinear(const ForceLaw& law, double depth, double contactRadius) noexcept
{
  constexpr double scatter = 0.025; // from tip to tip, over depth / contact radius
  constexpr double ofFlat = 0.1;    // with how sharp its edge is
  const double ratio = largeStrainOf(
    depth, contactRadius, std::numeric_limits<double>::infinity(), law.material().poissonRatio);
  return std::abs(ratio - 1.0) +
    (std::holds_alternative<PunchTip>(law.tip()) ? ofFlat : scatter) * depth / contactRadius;
}

// of a coated body: thinner ones are answered as this [m]
double thinnestBody(const ForceLaw& law)
{
  const Coatings& coatings = law.settings().coatings;
  return coatings.empty()
    ? 0.0
    : coatings.thickness() + CoatedBody::kMinBodyThickness * baseRadius(law.tip());
}

double fraction(double part, double whole) noexcept
{
  return whole > 0.0 ? std::abs(part) / whole : 0.0;
}

// a value to show: what is not a number is as bad as can be
double shown(double value) noexcept
{
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : std::abs(value);
}

bool isRound(const Tip& tip) noexcept
{
  return std::holds_alternative<SphereTip>(tip) || std::holds_alternative<ParaboloidTip>(tip);
}

bool isTiltCorrected(const ForceLaw& law) noexcept
{
  return law.settings().mode == LawMode::Corrected && law.settings().inclination &&
    std::holds_alternative<ConeTip>(law.tip());
}

// Tilt of the surface to the tool: the factor of inclination is that of one plane, and where the
// normals below the tool differ, some of the surface is inclined by more than their mean.
double steepestTilt(const ForceLaw& law, const ContactGeometry& local) noexcept
{
  constexpr double kMost = 2.0; // [-] of the spread: the two sides of an edge, the rim of a dome
  return std::abs(local.tilt) + (isTiltCorrected(law) ? kMost * std::abs(local.normalSpread) : 0.0);
}

// How much of the normals' spread no even curvature explains: bends and a scanner's noise. That of
// a paraboloid within the radius r of smoothing, at most sqrt(2) a, is r^2 / 6 of each principal
// curvature's square.
double bendBelow(const ContactGeometry& local, double contactRadius) noexcept
{
  const double even = (local.surfaceCurvature * local.surfaceCurvature +
                        local.curvatureSpread * local.curvatureSpread) *
    contactRadius * contactRadius * 2.0 / 3.0;
  return std::sqrt(std::max(0.0, local.normalSpread * local.normalSpread - even));
}

// Part of the force that a flat tip lacks on a curved surface, which it meets at one place first:
// 2 E* int r^2 / R0 over the contact (Sneddon 1965).
double lackOfFlat(
  const ForceLaw& law, const ContactGeometry& local, const Response& response) noexcept
{
  const double lack = 2.0 / 3.0 * law.material().contactModulus() * local.surfaceCurvature *
    std::pow(response.contactRadius, 3);
  return fraction(lack, response.force);
}

Rule curvatureRule(
  const ForceLaw& law, const ContactGeometry& local, const Response& response) noexcept
{
  constexpr const char* kName = "curvature";
  if (flatRadius(law.tip()) > 0.0)
  {
    return { kName, "-", shown(lackOfFlat(law, local, response)), kFlatOnCurved,
      "a flat tip meets a curved surface at one place first, which takes 5 % of its force" };
  }
  const double curved = shown(local.surfaceCurvature * baseRadius(law.tip()));
  if (law.settings().mode != LawMode::Corrected || !law.settings().curvature)
  {
    return { kName, "-", curved, kPaperCurvature,
      "a surface curved more than a third of the tip is not flat (Sec. 3.2)" };
  }
  return { kName, "-", curved, local.surfaceCurvature < 0.0 ? kHollow : 1.0,
    "a surface curved as much as the tip is no small correction" };
}

const char* whyThick(const ForceLaw& law, bool isTooThin) noexcept
{
  if (isTooThin)
  {
    return "below its coatings a thinner body than a fifth of the tip's radius counts as that "
           "thick";
  }
  return law.settings().mode == LawMode::Corrected
    ? "a wider contact than 0.6 of the thickness was not compared with finite elements"
    : "the tissue is too thin here: the base adds more than 7 %";
}

const char* whyInclined(const ForceLaw& law) noexcept
{
  if (isRound(law.tip()))
  {
    return "beyond 21.6 degrees the axial share of the force is 7 % short (Eq. 7)";
  }
  return isTiltCorrected(law)
    ? "the surface, or at an edge one side of it, is inclined more than boundary elements were "
      "compared at"
    : "a tilted tip no longer meets the surface as an upright one";
}

// tilt at which the force on this tip is wrong by a just noticeable difference
double tiltLimit(const ForceLaw& law)
{
  if (isRound(law.tip()))
  {
    return tiltOfShare(Validity::kJustNoticeable);
  }
  return isTiltCorrected(law) ? tiltReach(law.tip()) : kConeTilt;
}

} // namespace

std::uint32_t brokenRules(std::span<const Rule> rules) noexcept
{
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < rules.size(); ++i)
  {
    bits |= rules[i].holds() ? 0U : 1U << i;
  }
  return bits;
}

Validity::Validity(const ForceLaw& law)
  : Validity(law, Limits{})
{
}

Validity::Validity(const ForceLaw& law, const Limits& limits)
  : law_(law)
  , best_(law.corrected())
  , limits_(limits)
  , thickness_(kVerifiedWidth)
  , tilt_(tiltLimit(law))
  , membrane_(membraneReach(law))
  , thinnest_(thinnestBody(law))
{
  if (law.settings().mode != LawMode::Corrected || !law.settings().thickness)
  {
    // where the layer's first order is just noticeable
    const Layer layer(law.material().poissonRatio, law.settings().base);
    thickness_ = kJustNoticeable / layer(0.0).slope[0];
  }
}

Rules Validity::operator()(const ContactGeometry& local, double edgeDistance) const noexcept
{
  const Tip& tip = law_.tip();
  const LawSettings& settings = law_.settings();
  const bool corrected = settings.mode == LawMode::Corrected;
  const Response response = law_(local);
  const double truth = best_(local).force;
  const double base = baseRadius(tip);
  ContactGeometry deepest = local; // the experiment of Eq. (9), at this place
  deepest.depth = limits_.deepest > 0.0 ? limits_.deepest : base;
  const double maximum = std::max(best_(deepest).force, truth);
  const double depth = std::max(0.0, local.depth);
  const LargeStrainGrid::Ratio ratio = best_.largeStrain(local);
  const double radius = response.contactRadius;
  const double linear = depth > 0.0 ? errorOfLinear(law_, depth, radius) : 0.0;
  const double ball = fractionOfBall(local.thickness, local.surfaceCurvature);
  const double bend = bendBelow(local, radius);

  return { {
    { "force_of_maximum", "-", shown(fraction(response.force - truth, maximum)), kJustNoticeable,
      "the force may differ from the best law known by more than 7 % of the maximum, about what a "
      "hand can notice (Eq. 9)" },
    { "force_of_itself", "-", shown(fraction(response.force - truth, truth)), kJustNoticeable,
      "the force may differ from the best law known by more than 7 %, about what a hand can "
      "notice" },
    { "inclination", "rad", shown(steepestTilt(law_, local)), tilt_, whyInclined(law_) },
    { "direction", "rad", shown(local.tilt), kDirection,
      "beyond 32 degrees a hand notices the direction of the force" },
    { "depth", "-", shown(depth / base), !corrected && isRound(tip) ? kPaperDepth : 1.0,
      corrected ? "deeper than the tip's radius nothing was compared with finite elements"
                : "deeper, the law departs from neo-Hookean finite elements by 7 % (Sec. 4.3)" },
    { "large_strain", "-",
      ratio.inside ? 0.0 : shown(std::max(linear, kLinearError * depth / membrane_)),
      settings.constitution == ConstitutiveModel::Linear ? std::numeric_limits<double>::infinity()
                                                         : kLinearError,
      "outside what finite elements were fitted to, large strain may add 3 % and more" },
    { "thickness", "-", shown(radius / local.thickness),
      local.thickness < thinnest_ ? 0.0 : thickness_, whyThick(law_, local.thickness < thinnest_) },
    { "edge", "-", shown(std::max(radius / edgeDistance, kEdge * bend / kBend)), kEdge,
      "nearer than five contact radii an edge yields, and below the tool a bend or a rough place "
      "whose normals differ by 9 degrees (rms)" },
    curvatureRule(law_, local, response),
    { "stiffness", "N/m", shown(response.stiffness), limits_.stableStiffness,
      "stiffer than the device renders without vibrating" },
    { "ellipse", "-", shown(law_.gapSpread(local)), EllipseFactor::kSlimmest,
      "a contact more than 2.6 times as long as wide leaves the place whose curvature is known" },
    { "support", "-", shown(radius * local.surfaceCurvature * ball), kSupport,
      "how a convex body is held changes the force by more than 5 % either way" },
    { "penetration", "-", shown(depth / local.thickness), kComparedDepth,
      "deeper than half the body nothing was compared with finite elements" },
    { "hollow", "-", shown(local.hollow), kAboveHollow,
      "a wall above a hollow, or free behind, bends, so that it is softer than this" },
  } };
}

} // namespace palp
