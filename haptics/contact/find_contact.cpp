#include "haptics/contact/find_contact.h"

#include "haptics/contact/ball_rule.h"
#include "haptics/contact/height_over.h"
#include "haptics/contact/paper_contact.h"
#include "haptics/contact/patch.h"
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
constexpr double kGrain = 0.25;    // [-] tip radii of the sums that stand for a part of the contact
constexpr double kFinest = 2.0;    // [-] such sums across the least contact
constexpr double kOut = 4.0;   // [-] 1 / contact sizes over the surface: all of a nose is outside
constexpr double kFront = 0.1; // [-] cosine over which the back of a sheet becomes its front
constexpr double kOff = 1e-7; // [-] tip radii off the surface: in it, rounding would say which side
constexpr double kCorner = 0.4;   // [-] of the least reach: the corner where the contact is wider
constexpr double kTilting = 0.15; // [-] of a tool's size: a body turns by less than 1 rad in it
constexpr double kFlat = 0.05;    // [rad] of tilt over which a flat end comes to stand on its rim

// the surface about the nearest point, smoothed as far as the contact and the mesh allow
struct Neighborhood
{
  double distance; // of the nearest point [m], negative inside the body
  BallSize size;
  PatchBall ball;
  Patch patch;
  int triangle = -1;   // nearest
  double apart = 0.0;  // from the nearest point [m]
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

// @param apart  from the nearest point, whatever side it is on [m]
Neighborhood look(const Surface& surface, const BallRule& rule, const Eigen::Vector3d& position,
  double distance, double apart) noexcept
{
  const BallSize size = rule(distance);
  const Sloped turning = turningOf(distance, size.smoothing);
  const PatchBall ball{ position, std::sqrt(size.squared.value), turning.value };
  const double inside =
    surface.closed() ? (distance < 0.0 ? 1.0 : 0.0) : smoothStep(0.5 - 0.5 * distance / apart);
  Patch patch = patchWithin(surface, ball, inside);
  // from here on they are over the place, with the ball that belongs to it
  const Eigen::Vector3d away = patch.normal.normalized();
  const PatchTurns& turns = patch.turns;
  patch.fading -= turning.slope * turns.moment * away;
  patch.volumeFading -= turning.slope * turns.volume * away;
  patch.slopes.normal +=
    (size.squared.slope * patch.area + turning.slope * turns.normal) * away.transpose();
  patch.slopes.weight +=
    (size.squared.slope * patch.slopes.area + turning.slope * turns.weight) * away;
  return { distance, size, ball, patch };
}

// of the normals about their mean: what that is shorter than they
double spreadOf(const Patch& patch) noexcept
{
  return 1.0 - patch.normal.norm() / patch.weight;
}

// whether the one nearest triangle, a fold perhaps, says inside while those about it say outside
bool isOrientationFlipped(const Neighborhood& here, const Eigen::Vector3d& outward) noexcept
{
  return here.distance < 0.0 && here.patch.orientationSum.dot(outward) > 0.0 &&
    here.patch.orientationSum.norm() > kMajority * here.patch.orientationWeight;
}

// Part of a contact that is left where a tool behind a sheet has come past its edge: of that the
// ball holds ever less.
double heldPart(const Neighborhood& here) noexcept
{
  const double smoothing = here.size.smoothing.value;
  const double held = here.size.squared.value - here.apart * here.apart;
  return smoothing > 0.0 ? smoothStep(held / (smoothing * smoothing)) : 1.0;
}

// How the length of the mean normal by the weight changes as a place moves [1/m].
Eigen::Vector3d shareSlope(const Patch& patch) noexcept
{
  const Eigen::Vector3d length = patch.slopes.normal.transpose() * patch.normal.normalized();
  return (length - (1.0 - spreadOf(patch)) * patch.slopes.weight) / patch.weight;
}

// Part of the curvature that is below the tool, where a coarse mesh tells it over a wider ball: a
// sphere's normals spread by at least twice as much as from where all of it counts. How that
// changes is not felt: an edge of facets comes and goes within micrometers.
double curvedPart(const Patch& patch, double curvature, double smoothing) noexcept
{
  const double spread = spreadOf(patch);
  const double ofSphere = curvature * curvature * smoothing * smoothing / 6.0;
  return 2.0 * spread < ofSphere ? smoothStep(std::max(0.0, 2.0 * spread / ofSphere)) : 1.0;
}

// How far the lowest point of a flat end is below its middle, over the tilt; with no corner where
// it lies flat.
Sloped rimOf(const Tip& tip, double tilt) noexcept
{
  const double sine = std::sin(tilt);
  const double root = std::hypot(sine, kFlat);
  return { flatRadius(tip) * (root - kFlat), flatRadius(tip) * sine * std::cos(tilt) / root };
}

// What of the body counts as the shape of the contact, and how that changes as the tool moves: with
// the place, with the radius as the height changes, and with the normal, which turns with the body.
// height: over a flat body
void measureShape(Contact& contact, const Surface& surface, const Tip& tip, const ToolPose& pose,
  const BallRule& rule, const Neighborhood& here, const Height& height, CurvatureOf of) noexcept
{
  const double grain = kGrain * (rule.nose() + flatRadius(tip));
  const double least = std::max(surface.shape().finest(), kFinest * grain);
  const Sloped wide = smoothMax(rule.contactRadius(height.value), { least }, kCorner * least);
  const double reach = std::sqrt(height.value * height.value + wide.value * wide.value);
  const double growth = (height.value + wide.value * wide.slope) / reach;
  const Eigen::Vector3d normal = here.patch.normal.normalized();
  const LocalShape shape = surface.shape()(here.ball.center, reach, normal, grain, of);
  const Eigen::Matrix3d turning = here.patch.slopes.normal.transpose() / here.patch.normal.norm();
  const auto turn = [&](const Eigen::Vector3d& across)
  { return Eigen::Vector3d(turning * across); };
  const auto slopeOf = [&](const LocalShape::Slope& one)
  { return Eigen::Vector3d(one.place + one.radius * growth * height.slope + turn(one.normal)); };
  contact.surfaceCurvature = shape.meanCurvature;
  contact.curvatureSpread = shape.curvatureSpread;
  contact.thickness = shape.thickness;
  contact.hollow = shape.hollow;
  contact.curvatureSlope = slopeOf(shape.meanCurvatureSlope);
  contact.spreadSlope = slopeOf(shape.curvatureSpreadSlope);
  contact.thicknessSlope = slopeOf(shape.thicknessSlope);
  const Eigen::Vector3d lean = pose.axis - pose.axis.dot(normal) * normal;
  const Eigen::Vector3d tilting = turn(lean) / std::max(lean.norm(), 1e-9);
  contact.tiltSlope =
    tilting / std::hypot(1.0, (kTilting * baseRadius(tip) * tilting).squaredNorm());
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
  const double apart = (position - nearest.point).norm();
  Neighborhood here = look(surface, rule, position, nearest.distance, apart);
  if (!surface.crossing() && isOrientationFlipped(here, position - nearest.point))
  {
    here = look(surface, rule, position, -nearest.distance, apart);
    if (here.distance >= reach)
    {
      return {};
    }
  }
  here.triangle = nearest.triangle;
  here.apart = apart;
  here.raised = raised;
  return here;
}

Contact exactContact(
  const Surface& surface, const Tip& tip, const ToolPose& pose, CurvatureOf of) noexcept
{
  const BallRule rule(tip, surface.edgeLength(), surface.facetLength());
  const std::optional<Neighborhood> here = lookBelow(surface, tip, pose, rule);
  if (!here || !(here->patch.normal.norm() > kRounding * here->patch.weight))
  {
    return {}; // by less than rounding, or between lobes that face each other
  }
  const Eigen::Vector3d& position = here->ball.center;
  const double share = 1.0 - spreadOf(here->patch);
  Contact contact;
  contact.normalSpread = std::acos(std::min(1.0, share));
  const HeightOver heightOver(here->patch, rule, here->distance, here->size);
  const Height flat = heightOver(here->distance, 0.0, Eigen::Vector3d::Zero());
  measureShape(contact, surface, tip, pose, rule, *here, flat, of);
  contact.curvedPart =
    curvedPart(here->patch, contact.surfaceCurvature, here->size.smoothing.value);
  const Height height = heightOver(flat.value, contact.curvedPart * contact.surfaceCurvature,
    contact.curvedPart * contact.curvatureSlope);
  contact.relief = height.value - here->distance;
  const Eigen::Vector3d upward = height.slope.normalized();
  const double facing = -pose.axis.dot(upward);
  contact.tilt = std::acos(std::clamp(facing, -1.0, 1.0));
  const Sloped rim = rimOf(tip, contact.tilt);
  const double depth = rule.nose() + rim.value + here->raised - height.value;
  Sloped part = smoothMin({ share / kCoherent, 1.0 / kCoherent }, { 1.0 }, kGradual);
  if (!surface.closed())
  {
    const double front = std::clamp(facing / kFront, 0.0, 1.0) * heldPart(*here);
    part = { front * part.value, front * part.slope };
  }
  contact.depth = part.value * depth;
  Eigen::Vector3d outward = part.value * height.slope;
  if (part.slope > 0.0) // of a center in the body it would push the tool out through a thin one
  {
    const double out = std::clamp(kOut * here->distance / here->size.smoothing.value, 0.0, 1.0);
    outward -= out * part.slope * depth * shareSlope(here->patch);
  }
  contact.center = position - height.value * outward.normalized();
  outward -= part.value * rim.slope * contact.tiltSlope;
  contact.slope = outward.norm();
  contact.normal = outward / contact.slope;
  contact.triangle = here->triangle;
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

Contact findContact(const Surface& surface, const Tip& tip, const ToolPose& pose, ContactRule rule,
  CurvatureOf of) noexcept
{
  if (!(pose.apex.allFinite() && pose.axis.allFinite()))
  {
    return {};
  }
  const Contact contact = rule == ContactRule::Paper ? paperContact(surface, tip, pose)
                                                     : exactContact(surface, tip, pose, of);
  const bool usable = contact.depth > 0.0 && std::isfinite(contact.depth) &&
    contact.normal.allFinite() && contact.center.allFinite();
  return usable ? contact : Contact{};
}

} // namespace palp
