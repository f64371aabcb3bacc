#include "haptics/contact/find_contact.h"

#include "haptics/contact/paper_contact.h"
#include "haptics/contact/patch.h"
#include "haptics/surface/closest_point.h"
#include "haptics/tip/profile.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

// Facets are smoothed out over a part of the contact, for what a scanner stepped comes through when
// the mesh is fine, but over enough of them to vanish and no more than the tick has time for
constexpr double kSmoothed = 0.63; // [-] of the contact's radius
constexpr double kFewest = 1.8;    // [-] edge lengths; below 1.5 the facets come through
constexpr double kMost = 6.5;      // [-] edge lengths
constexpr double kCoherent = 0.5;  // [-] length of the mean normal below which lobes oppose
constexpr double kMajority = 0.5;  // [-] length of the mean normal that is a clear majority
constexpr double kRounding = 1e-9; // [-]
constexpr double kGrain = 0.25;    // [-] tip radii of the sums that stand for a part of the contact
constexpr double kFinest = 2.0;    // [-] such sums across the least contact
constexpr double kFront = 0.1;     // [-] cosine over which the back of a sheet becomes its front

// the ball that meets a smooth body first; a sharp or flat tip has one of radius zero
double noseRadius(const Tip& tip) noexcept
{
  if (const auto* sphere = std::get_if<SphereTip>(&tip))
  {
    return sphere->radius;
  }
  if (const auto* blunt = std::get_if<BluntConeTip>(&tip))
  {
    return blunt->tipRadius;
  }
  if (const auto* paraboloid = std::get_if<ParaboloidTip>(&tip))
  {
    return paraboloid->radius;
  }
  if (const auto* profile = std::get_if<ProfileTip>(&tip))
  {
    return profile->profile->noseRadius();
  }
  return 0.0;
}

// radius of the contact, as the undeformed surface cuts it out of the tool; a sharp or flat end is
// inside the body, where a wider ball would reach a second wall long before the tool does
double contactRadius(const Tip& tip, double nose, double distance) noexcept
{
  if (nose > 0.0)
  {
    const double outside = std::max(0.0, distance);
    return std::sqrt(std::max(0.0, nose * nose - outside * outside));
  }
  const double depth = std::abs(distance);
  if (const double flat = flatRadius(tip); flat > 0.0)
  {
    return std::min(flat, std::max(0.5 * depth, 0.25 * flat));
  }
  const auto* cone = std::get_if<ConeTip>(&tip);
  const double slope = cone != nullptr ? std::tan(cone->halfAngle) : 1.0;
  return std::min(std::min(slope, 1.0) * depth, baseRadius(tip));
}

// Distance to the surface that the facets stand for: on planes and spheres w = Q - q has the means
// 1/2 and 1/3 of Q - h^2 and of its square, so h^2 = Q - 3/2 square / weight, without a corner
// where a triangle leaves the ball. Along the mean normal, so that a wall behind does not count.
double smoothed(double distance, double radius, double squaredBall, const Patch& patch) noexcept
{
  // no w is more than the ball's square over the nearest point's, whatever rounding makes of a ball
  // that a corner or an edge only just enters
  const double reached = std::clamp(
    1.5 * patch.square.dot(patch.normal) / patch.normal.squaredNorm(), 0.0, 1.5 * radius * radius);
  const double excess = squaredBall - reached - distance * distance; // h^2 - distance^2
  // close to the surface the square says little: the correction fades there
  const double scale = std::max(distance * distance, radius * radius / 16.0);
  return distance * std::sqrt(std::max(0.25, 1.0 + excess / scale));
}

// the surface about the nearest point, smoothed as far as the contact and the mesh allow
struct Neighborhood
{
  double distance;    // of the nearest point [m], negative inside the body
  double radius;      // of smoothing [m]
  double squaredBall; // Q [m^2]
  Patch patch;
};

Neighborhood look(
  const Surface& surface, const Tip& tip, const Eigen::Vector3d& position, double distance) noexcept
{
  const double contact = contactRadius(tip, noseRadius(tip), distance);
  const double edge = surface.edgeLength();
  const double radius =
    std::min(contact, std::clamp(kSmoothed * contact, kFewest * edge, kMost * edge));
  const double squaredBall = distance * distance + radius * radius;
  const double side = radius > 0.0 ? std::clamp(distance / radius, -1.0, 1.0) : 0.0;
  return { distance, radius, squaredBall,
    patchWithin(surface, position, std::sqrt(squaredBall), side, std::max(radius, 1e-9)) };
}

// whether the one nearest triangle, a fold perhaps, says inside while those about it say outside
bool isOrientationFlipped(const Neighborhood& here, const Eigen::Vector3d& outward) noexcept
{
  return here.distance < 0.0 && here.patch.orientationSum.dot(outward) > 0.0 &&
    here.patch.orientationSum.norm() > kMajority * here.patch.orientationWeight;
}

Contact exactContact(const Surface& surface, const Tip& tip, const ToolPose& pose) noexcept
{
  const double nose = noseRadius(tip);
  const auto [position, reach] = reachOf(tip, pose, ContactRule::Exact);
  if (surface.closed() && squaredDistance(surface.tree().nodes()[0], position) > reach * reach)
  {
    return {}; // quickly; behind an open sheet, contact may reach beyond its box
  }
  const ClosestPoint nearest =
    findClosestPoint(surface, position, std::numeric_limits<double>::infinity());
  if (nearest.triangle < 0 || nearest.distance >= reach)
  {
    return {};
  }
  Neighborhood here = look(surface, tip, position, nearest.distance);
  if (!surface.crossing() && isOrientationFlipped(here, position - nearest.point))
  {
    here = look(surface, tip, position, -nearest.distance);
    if (here.distance >= reach)
    {
      return {};
    }
  }
  const auto& [distance, radius, squaredBall, patch] = here;
  const double length = patch.normal.norm();
  if (!(length > kRounding * patch.weight))
  {
    return {}; // by less than rounding, or between lobes that face each other
  }
  Contact contact;
  contact.normal = patch.normal / length;
  contact.normalSpread = std::acos(std::min(1.0, length / patch.weight));
  const double facing = -pose.axis.dot(contact.normal);
  contact.tilt = std::acos(std::clamp(facing, -1.0, 1.0));
  const double height = smoothed(distance, radius, squaredBall, patch);
  const double rim = flatRadius(tip) * std::sin(contact.tilt); // the lowest point of a flat end
  contact.depth = (nose + rim - height) * std::min(1.0, length / (kCoherent * patch.weight));
  if (!surface.closed())
  {
    contact.depth *= std::clamp(facing / kFront, 0.0, 1.0);
  }
  contact.center = position - height * contact.normal;
  contact.triangle = nearest.triangle;
  const double grain = kGrain * (nose + flatRadius(tip));
  const double span =
    std::max({ contactRadius(tip, nose, distance), surface.shape().finest(), kFinest * grain });
  const LocalShape shape =
    surface.shape()(position, std::hypot(distance, span), contact.normal, grain);
  contact.surfaceCurvature = shape.meanCurvature;
  contact.curvatureSpread = shape.curvatureSpread;
  contact.thickness = shape.thickness;
  contact.hollow = shape.hollow;
  contact.edgeDistance = std::min(surface.shape().edgeDistance(contact.center),
    surface.edgeDistance(contact.center, contact.triangle));
  return contact;
}

} // namespace

Reach reachOf(const Tip& tip, const ToolPose& pose, ContactRule rule) noexcept
{
  if (rule == ContactRule::Paper)
  {
    const double middle = 0.5 * paperLength(tip);
    return { pose.apex - middle * pose.axis, std::hypot(middle, baseRadius(tip)) };
  }
  const double nose = noseRadius(tip);
  return { pose.apex - nose * pose.axis, nose + flatRadius(tip) };
}

Contact findContact(
  const Surface& surface, const Tip& tip, const ToolPose& pose, ContactRule rule) noexcept
{
  if (!(pose.apex.allFinite() && pose.axis.allFinite()))
  {
    return {};
  }
  const Contact contact = rule == ContactRule::Paper ? paperContact(surface, tip, pose)
                                                     : exactContact(surface, tip, pose);
  const bool usable = contact.depth > 0.0 && std::isfinite(contact.depth) &&
    contact.normal.allFinite() && contact.center.allFinite();
  return usable ? contact : Contact{};
}

} // namespace palp
