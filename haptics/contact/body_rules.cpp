#include "haptics/contact/body_rules.h"

#include "haptics/contact/ball/ball_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

// How near a contact is to the edge of a sharp wedge, over the distance at which that yields 7 %:
// by finite elements one of 60 and 45 degrees does 8 and 30 times as much as one of 90, and up to 4
// times where the wedge's slant face is not all the way below.
double wedgeFraction(const Contact& contact, double contactRadius) noexcept
{
  constexpr double kRight = 0.5 * std::numbers::pi;
  constexpr double kSlimmest = std::numbers::pi / 6.0; // wedge that finite elements were asked of
  constexpr double kLimit = 0.2;                       // a / distance, at 90 degrees
  constexpr double kOverSlant = 0.95; // of the wedge's own thickness: it ends deeper than that
  if (std::isinf(contact.wedgeDistance))
  {
    return 0.0;
  }
  const double angle = std::clamp(contact.wedgeAngle, kSlimmest, kRight);
  const double part = contact.thickness / (contact.wedgeDistance * std::tan(angle));
  const double most = std::pow(kRight / angle, 5);
  const double factor = part > kOverSlant ? most : std::min(most, 4.0 * part * part);
  return factor * contactRadius / (kLimit * contact.wedgeDistance);
}

} // namespace

Rule lobeRule(
  const Surface& surface, const Contact& contact, double contactRadius, Base base) noexcept
{
  constexpr double kModulus = 1.25; // E* over E, of liver
  constexpr double kLobe = 2.0;     // of the thickness, the least extent of the body
  constexpr double kPlate = 2.5;    // likewise, the side of a square plate of its size
  // whatever has its base unset: even a ball that hangs from one side gives way
  constexpr double kUnset = 0.9;
  const BoxTree::Node& all = surface.tree().nodes().front();
  double least = std::numeric_limits<double>::infinity();
  double squares = 0.0;
  double box = 1.0;
  double high = 0.0; // along the normal [m]
  for (std::size_t k = 0; k < all.low.size(); ++k)
  {
    const double extent = static_cast<double>(all.high[k]) - static_cast<double>(all.low[k]);
    least = std::min(least, extent);
    squares += extent * extent;
    box *= extent;
    high += std::abs(contact.normal[static_cast<int>(k)]) * extent;
  }
  const double wide = std::sqrt(0.5 * squares);
  Rule rule{ "lobe", "-", 0.0, 1.0,
    "as high and slim as a column, or nobody says what is below and it is a wedge, or thinner than "
    "half of the body or 0.4 of its extent: what nothing holds beside or below gives way, and is "
    "felt softer; --base says that it lies on something rigid, palp organ and --organ take all of "
    "it into "
    "account" };
  if (contact.touching())
  {
    const double thickness = contact.thickness;
    const double wedge = wedgeFraction(contact, contactRadius);
    const double lobe =
      std::max({ kUnset, least / (kLobe * thickness), wide / (kPlate * thickness), wedge });
    // that of a half-space below the body is in the law
    const double column = std::isfinite(thickness) && box > 0.0
      ? kModulus * thickness * high / box - std::numbers::inv_pi / thickness
      : 0.0;
    // the slant face of a wedge may be what lies on something
    rule.value = std::max(2.0 * contactRadius * column / Validity::kJustNoticeable,
      base == Base::Unset ? lobe : std::min(kUnset, wedge));
  }
  return rule;
}

Rule openRule(const Surface& surface, const Contact& contact) noexcept
{
  const bool isUnknown = contact.touching() && !surface.closed() && std::isinf(contact.thickness);
  return { "open", "-", isUnknown ? 1.0 : 0.0, 0.5,
    "the surface is open, and what lies behind it is not known: the body is taken as without end, "
    "too soft by a fifth where its base is six contact radii below" };
}

Rule unevenRule(const Tip& tip, const Contact& contact) noexcept
{
  constexpr double kShallow = 0.1; // of the base: less deep, forces are small
  constexpr double kUneven = 0.04; // of the depth: a tenth of the force, at most (elements)
  const double depth = std::max(contact.depth, kShallow * baseRadius(tip));
  return { "uneven", "-", contact.touching() ? std::abs(contact.relief) / depth : 0.0, kUneven,
    "a crease, a bump or a coarse triangle stands out of the even surface that is taken instead, "
    "or back from it, by 4 % of the depth: the force may be off by a tenth" };
}

Rule facetRule(const Surface& surface, const Tip& tip, const Contact& contact) noexcept
{
  Rule rule{ "facets", "-", 0.0, 1.0,
    "triangles that stand for what is round are smoothed over an edge beside: up to 20 % too stiff "
    "2 mm from one by those of 4 mm; a finer mesh tells it" };
  if (contact.touching() && noseRadius(tip) > 0.0)
  {
    const double height = noseRadius(tip) - contact.depth;
    const double smoothed =
      BallRule(tip, surface.edgeLength(), surface.facetLength())(height).smoothing.value;
    const double own = BallRule(tip, surface.edgeLength(), 0.0)(height).smoothing.value;
    rule.value = smoothed > own ? smoothed / contact.edgeDistance : 0.0;
  }
  return rule;
}

} // namespace palp
