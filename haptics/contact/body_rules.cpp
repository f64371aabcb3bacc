#include "haptics/contact/body_rules.h"

#include "haptics/contact/ball/ball_rule.h"
#include "haptics/surface/ray.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

// of the limit, where it depends on what nobody says: even a ball that hangs from one side gives
// way
constexpr double kUnsure = 0.9;
constexpr double kSlant = units::fromDegrees(80.0); // less between two faces of a wedge

// from a place to where a box ends [m]
double extentAlong(
  const BoxTree::Node& box, const Eigen::Vector3d& from, const Eigen::Vector3d& way) noexcept
{
  double farthest = 0.0;
  for (std::size_t k = 0; k < box.low.size(); ++k)
  {
    const auto axis = static_cast<Eigen::Index>(k);
    const auto end = static_cast<double>(way[axis] > 0.0 ? box.high[k] : box.low[k]);
    farthest += way[axis] * (end - from[axis]);
  }
  return farthest;
}

// How near a contact is to where two faces of a wedge would meet, over the distance at which that
// yields 7 %: by finite elements one of 60 and 45 degrees does 8 and 30 times as much as one of 90,
// less where its slant face ends before it is below.
double fractionOf(double distance, double angle, double thickness, double contactRadius) noexcept
{
  constexpr double kLimit = 0.2; // a / distance, at 90 degrees
  constexpr double kSlimmest = std::numbers::pi / 6.0;
  constexpr double kOverSlant = 0.95; // of the wedge's own thickness: its slant face is below
  constexpr double kOver = 4.0;       // times as much at most where that ends before
  const double below = thickness / (distance * std::tan(angle));
  const double most = std::pow(0.5 * std::numbers::pi / std::max(kSlimmest, angle), 5);
  const double factor =
    angle > kSlant || below > kOverSlant ? most : std::min(most, kOver * below * below);
  return factor * contactRadius / (kLimit * distance);
}

// The same, by what faces rays meet that leave a contact slantwise; what few meet, as rough places
// and vessels, does not count. A slant face may be what lies on something, where that is said.
double wedgeFraction(
  const Surface& surface, const Contact& contact, double contactRadius, Base base) noexcept
{
  constexpr int kRays = 12;
  constexpr int kFew = 2;
  constexpr double kDown = units::fromDegrees(40.0);
  constexpr double kWidest = units::fromDegrees(95.0); // of an edge that is rounded
  constexpr double kToEdge = 0.95; // of the distance to a sharp one, whose own rule tells it
  constexpr double kCutOff = 1.5;  // of what there is of the body, the distance of the edge
  const Eigen::Vector3d right = contact.normal.unitOrthogonal();
  const Eigen::Vector3d ahead = contact.normal.cross(right);
  const BoxTree::Node& all = surface.tree().nodes().front();
  std::array<double, kRays> fractions{};
  for (int i = 0; i < kRays; ++i)
  {
    const double turn = 2.0 * std::numbers::pi * i / kRays;
    const Eigen::Vector3d way =
      std::cos(kDown) * (std::cos(turn) * right + std::sin(turn) * ahead) -
      std::sin(kDown) * contact.normal;
    const RayHit hit = rayExit(surface.tree(), contact.center, way);
    if (hit.triangle < 0)
    {
      continue;
    }
    const Eigen::Vector3d face =
      unitNormal(surface.points(), surface.triangles()[static_cast<std::size_t>(hit.triangle)]);
    const double facing = face.dot(contact.normal);
    const double angle = std::numbers::pi - std::acos(std::clamp(facing, -1.0, 1.0));
    const Eigen::Vector3d outward = (face - facing * contact.normal).normalized();
    const double distance = hit.distance * face.dot(way) / std::sin(angle);
    const double there = extentAlong(all, contact.center, outward);
    const bool isToldByEdge = angle > kSlant && kToEdge * contact.edgeDistance < distance;
    if (angle < kWidest && distance < kCutOff * there && !isToldByEdge)
    {
      const bool mayLie = angle < kSlant && base != Base::Unset;
      const double fraction = fractionOf(distance, angle, contact.thickness, contactRadius);
      fractions[static_cast<std::size_t>(i)] = mayLie ? std::min(kUnsure, fraction) : fraction;
    }
  }
  std::ranges::nth_element(fractions, fractions.begin() + kFew, std::greater());
  return fractions[kFew];
}

} // namespace

Rule lobeRule(
  const Surface& surface, const Contact& contact, double contactRadius, Base base) noexcept
{
  constexpr double kModulus = 1.25; // E* over E, of liver
  constexpr double kLobe = 2.0;     // of the thickness, the least extent of the body
  constexpr double kPlate = 2.5;    // likewise, the side of a square plate of its size
  const BoxTree::Node& all = surface.tree().nodes().front();
  double least = std::numeric_limits<double>::infinity();
  double longest = 0.0;
  double squares = 0.0;
  double box = 1.0;
  double high = 0.0; // along the normal [m]
  for (std::size_t k = 0; k < all.low.size(); ++k)
  {
    const double extent = static_cast<double>(all.high[k]) - static_cast<double>(all.low[k]);
    least = std::min(least, extent);
    longest = std::max(longest, extent);
    squares += extent * extent;
    box *= extent;
    high += std::abs(contact.normal[static_cast<int>(k)]) * extent;
  }
  const double wide = std::max(longest, std::sqrt(0.5 * squares));
  Rule rule{ "lobe", "-", 0.0, 1.0,
    "as high and slim as a column, or beside an edge that is rounded, or nobody says what is below "
    "and it is a wedge, or thinner than half of the body or 0.4 of its extent: what nothing holds "
    "beside or below gives way, and is "
    "felt softer; --base says that it lies on something rigid, palp organ and --organ take all of "
    "it into account" };
  if (contact.touching())
  {
    const double thickness = contact.thickness;
    const double wedge = wedgeFraction(surface, contact, contactRadius, base);
    const double lobe =
      std::max({ kUnsure, least / (kLobe * thickness), wide / (kPlate * thickness), wedge });
    // that of a half-space below the body is in the law
    const double column = std::isfinite(thickness) && box > 0.0
      ? kModulus * thickness * high / box - std::numbers::inv_pi / thickness
      : 0.0;
    rule.value = std::max(
      2.0 * contactRadius * column / Validity::kJustNoticeable, base == Base::Unset ? lobe : wedge);
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
