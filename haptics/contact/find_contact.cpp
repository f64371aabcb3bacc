#include "haptics/contact/find_contact.h"

#include "haptics/contact/ball/ball_rule.h"
#include "haptics/contact/ball/height_over.h"
#include "haptics/contact/ball/patch.h"
#include "haptics/contact/contact_shape.h"
#include "haptics/contact/overlap/tool_solid.h"
#include "haptics/contact/overlap_contact.h"
#include "haptics/contact/paper_contact.h"
#include "haptics/numerics/smooth_step.h"
#include "haptics/surface/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace palp
{
namespace
{

constexpr double kCoherent = 0.5;  // [-] length of the mean normal below which lobes oppose
constexpr double kGradual = 0.2;   // [-] where that begins, of the corner of this rule
constexpr double kMajority = 0.5;  // [-] length of the mean normal that is a clear majority
constexpr double kRounding = 1e-9; // [-]
constexpr double kEntry = 0.4;     // [-] 1 / power by which a spread grows as an edge comes in
constexpr double kSudden = 4.0;    // [-] most of a slope where the far wall of a lobe comes in
constexpr double kShallow = 0.75;  // [-] contact sizes inside, to which the nearest point counts
constexpr double kFront = 0.1;     // [-] cosine over which the back of a sheet becomes its front
constexpr double kOff = 1e-7; // [-] tip radii off the surface: in it, rounding would say which side

// the surface about the nearest point, smoothed as far as the contact and the mesh allow
struct Neighborhood
{
  double distance;      // of the nearest point [m], negative inside the body
  Eigen::Vector3d away; // how that changes as the place moves [-]
  BallSize size;
  PatchBall ball;
  Patch patch;
  int triangle = -1;   // nearest
  double held = 1.0;   // part that is left past the edge of a sheet [-]
  double raised = 0.0; // the ball's center, off the surface [m]
};

// how fast triangles fade that turn their back, by how far the center is over the surface
Sloped turningOf(double distance, const Sloped& smoothing) noexcept
{
  const double radius = smoothing.value;
  if (!(radius > 0.0))
  {
    return { 0.0 };
  }
  const double side = std::clamp(distance / radius, -1.0, 1.0);
  const double squared = radius * radius;
  const bool isBetween = std::abs(distance) < radius;
  return { side / radius,
    isBetween ? (1.0 - 2.0 * side * smoothing.slope) / squared
              : -side * smoothing.slope / squared };
}

// less where a center is so deep inside that the nearest point leaps from wall to wall
double shallowPart(double distance, double smoothing) noexcept
{
  return std::clamp(2.0 + distance / (kShallow * smoothing), 0.0, 1.0);
}

// @param distance  of the nearest point, or about as high as the place is [m]
// @param inside    how far it is inside the body [-]
// @param outward   how that distance changes as the place moves
Neighborhood look(const Surface& surface, const BallRule& rule, const Eigen::Vector3d& position,
  double distance, double inside, const Eigen::Vector3d& outward) noexcept
{
  const BallSize size = rule(distance);
  const Sloped turning = turningOf(distance, size.smoothing);
  const PatchBall ball{ position, std::sqrt(size.squared.value), turning.value };
  Patch patch = patchWithin(surface, ball, inside);
  // from here on they are over the place, with the ball that belongs to it
  const Eigen::Vector3d mean = patch.normal.normalized();
  const Eigen::Vector3d away =
    mean + shallowPart(distance, size.smoothing.value) * (outward - mean);
  const PatchTurns& turns = patch.turns;
  patch.fading -= turning.slope * turns.moment * away;
  patch.volumeFading -= turning.slope * turns.volume * away;
  patch.slopes.normal +=
    (size.squared.slope * patch.area + turning.slope * turns.normal) * away.transpose();
  patch.slopes.weight +=
    (size.squared.slope * patch.slopes.area + turning.slope * turns.weight) * away;
  return { distance, away, size, ball, patch };
}

// whether the one nearest triangle, a fold perhaps, says inside while those about it say outside
bool isOrientationFlipped(const Neighborhood& here, const Eigen::Vector3d& outward) noexcept
{
  return here.distance < 0.0 && here.patch.orientationSum.dot(outward) > 0.0 &&
    here.patch.orientationSum.norm() > kMajority * here.patch.orientationWeight;
}

// about the nearest point
// @param from  there to the position, whatever side it is on [m]
Neighborhood lookAbout(const Surface& surface, const BallRule& rule,
  const Eigen::Vector3d& position, double distance, const Eigen::Vector3d& from) noexcept
{
  const double inside = surface.closed() ? (distance < 0.0 ? 1.0 : 0.0)
                                         : smoothStep(0.5 - 0.5 * distance / from.norm());
  Neighborhood here = look(
    surface, rule, position, distance, inside, std::copysign(1.0, distance) * from.normalized());
  if (surface.closed() || !here.patch.isOpen)
  {
    return here;
  }
  // past the border, the nearest point is farther than the plane of the sheet is below
  const Height height =
    HeightOver(here.patch, rule, distance, here.size)(distance, 0.0, Eigen::Vector3d::Zero());
  // behind the sheet, the ball holds ever less of it
  const double smoothing = here.size.smoothing.value;
  const double held = here.size.squared.value - from.squaredNorm();
  here = look(surface, rule, position, height.value, inside, height.slope);
  here.held = smoothing > 0.0 ? smoothStep(held / (smoothing * smoothing)) : 1.0;
  return here;
}

// A part of something, and how it changes as a place moves.
struct Part
{
  double value = 1.0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero(); // [1/m]
};

// Part of the curvature that is below the tool, where a coarse mesh tells it over a wider ball: a
// smooth body's normals spread by twice as much as from where all of it counts. They are compared
// over the wider ball, of radius wide [m] by the height, so that an edge comes in gradually.
Part curvedPart(const Neighborhood& here, const NormalSum& normals, const Contact& contact,
  const BallRule& rule, const Sloped& wide, const Eigen::Vector3d& heightSlope) noexcept
{
  const auto [smoothing, growth] = here.size.smoothing;
  const Sloped own = rule.contactRadius(here.distance);
  const double across = wide.value * smoothing / own.value;
  const double mean = contact.surfaceCurvature;
  const double apart = contact.curvatureSpread;
  const double squares = mean * mean + apart * apart;
  const double ofBody = squares * across * across / 12.0;
  const double spread = std::max(kRounding, normals.spread());
  if (!(spread < ofBody))
  {
    return {};
  }
  const double entered = std::pow(spread / ofBody, kEntry);
  const Eigen::Vector3d wider = wide.slope / wide.value * heightSlope +
    (growth / smoothing - own.slope / own.value) * here.away;
  const Eigen::Vector3d rounder =
    (mean * contact.curvatureSlope + apart * contact.spreadSlope) / squares;
  return { smoothStep(entered),
    -6.0 * kEntry * entered * entered * (1.0 - entered) * shallowPart(here.distance, smoothing) *
      (normals.shareSlope() / spread + 2.0 * (rounder + wider)) };
}

std::optional<Neighborhood> lookBelow(
  const Surface& surface, const Tip& tip, const ToolPose& pose, const BallRule& rule) noexcept
{
  auto [position, reach] = reachOf(tip, pose, ContactRule::Exact);
  if (surface.closed() && squaredDistance(surface.tree().nodes()[0], position) > reach * reach)
  {
    return {}; // quickly; behind an open sheet, contact may reach beyond its box
  }
  ClosestPoint nearest =
    findClosestPoint(surface, position, std::numeric_limits<double>::infinity());
  if (nearest.triangle < 0 || nearest.distance >= reach)
  {
    return {};
  }
  const double off = kOff * baseRadius(tip);
  const double raised = std::abs(nearest.distance) < off ? off - nearest.distance : 0.0;
  if (raised > 0.0)
  {
    const auto triangle = static_cast<std::size_t>(nearest.triangle);
    position += raised * unitNormal(surface.points(), surface.triangles()[triangle]);
    nearest.distance = off;
  }
  const Eigen::Vector3d from = position - nearest.point;
  Neighborhood here = lookAbout(surface, rule, position, nearest.distance, from);
  if (!surface.crossing() && isOrientationFlipped(here, from))
  {
    here = lookAbout(surface, rule, position, -nearest.distance, from);
    if (here.distance >= reach)
    {
      return {};
    }
  }
  here.triangle = nearest.triangle;
  here.raised = raised;
  return here;
}

Contact ballContact(
  const Surface& surface, const Tip& tip, const ToolPose& pose, CurvatureOf of) noexcept
{
  const BallRule rule(tip, surface.edgeLength(), surface.facetLength());
  const std::optional<Neighborhood> here = lookBelow(surface, tip, pose, rule);
  if (!here || !(here->patch.normal.norm() > kRounding * here->patch.weight))
  {
    return {}; // by less than rounding, or between lobes that face each other
  }
  const Eigen::Vector3d& position = here->ball.center;
  const PatchSlopes& slopes = here->patch.slopes;
  const NormalSum normals{ here->patch.normal, slopes.normal, here->patch.weight, slopes.weight };
  const double share = 1.0 - normals.spread();
  Contact contact;
  measureNormal(contact, pose, normals);
  const HeightOver heightOver(here->patch, rule, here->distance, here->size);
  const Height flat = heightOver(here->distance, 0.0, Eigen::Vector3d::Zero());
  const Sloped wide = shapeRadius(surface, tip, rule.contactRadius(flat.value));
  const double reach = std::hypot(flat.value, wide.value);
  const ShapeBall below{ .center = position,
    .radius = reach,
    .normal = contact.bodyNormal,
    .widening = (flat.value + wide.value * wide.slope) / reach * flat.slope,
    .turning = contact.turning };
  measureShape(contact, surface, tip, below, of);
  const Part curved = curvedPart(*here, normals, contact, rule, wide, flat.slope);
  contact.curvedPart = curved.value;
  const Height height = heightOver(flat.value, curved.value * contact.surfaceCurvature,
    curved.value * contact.curvatureSlope + contact.surfaceCurvature * curved.slope);
  contact.height = height.value;
  contact.rising = height.slope;
  contact.relief = height.value - here->distance;
  const double facing = -pose.axis.dot(height.slope.normalized());
  contact.tilt = std::acos(std::clamp(facing, -1.0, 1.0));
  const double depth = rule.nose() + here->raised - height.value;
  Sloped part = smoothMin({ share / kCoherent, 1.0 / kCoherent }, { 1.0 }, kGradual);
  if (!surface.closed())
  {
    const double front =
      std::clamp(-pose.axis.dot(contact.bodyNormal) / kFront, 0.0, 1.0) * here->held;
    part = { front * part.value, front * part.slope };
  }
  contact.depth = part.value * depth;
  Eigen::Vector3d outward = part.value * height.slope;
  if (part.slope > 0.0)
  {
    const Eigen::Vector3d coming = part.slope * depth * normals.shareSlope();
    outward -= std::min(1.0, kSudden / coming.norm()) * coming;
  }
  contact.center = position - height.value * outward.normalized();
  contact.slope = outward.norm();
  contact.normal = outward / contact.slope;
  contact.triangle = here->triangle;
  return contact;
}

Contact exactContact(
  const Surface& surface, const Tip& tip, const ToolPose& pose, CurvatureOf of) noexcept
{
  Contact contact = noseRadius(tip) > 0.0 ? ballContact(surface, tip, pose, of)
                                          : overlapContact(surface, tip, pose, of);
  if (!contact.touching() || contact.triangle < 0) // or by what is not a number
  {
    return {};
  }
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
  if (const double nose = noseRadius(tip); nose > 0.0)
  {
    return { pose.apex - nose * pose.axis, nose };
  }
  constexpr double kBelowASheet = 0.06; // [m] which counts on the shaft as far as the tool is in it
  const ToolSolid solid(tip);
  const double middle = 0.5 * std::max(solid.top(), kBelowASheet);
  return { pose.apex - middle * pose.axis, std::hypot(middle, solid.outerRadius()) };
}

Contact findContact(const Surface& surface, const Tip& tip, const ToolPose& pose, ContactRule rule,
  CurvatureOf of) noexcept
{
  if (!(pose.apex.allFinite() && pose.axis.allFinite()))
  {
    return {};
  }
  const Contact contact = rule == ContactRule::Paper ? paperContact(surface, tip, pose)
                                                     : exactContact(surface, tip, pose, of);
  const bool usable = contact.depth > 0.0 && std::isfinite(contact.depth) && contact.slope > 0.0 &&
    contact.normal.allFinite() && contact.center.allFinite();
  return usable ? contact : Contact{};
}

} // namespace palp
