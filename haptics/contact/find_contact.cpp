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
constexpr double kFront = 0.1;     // [-] cosine over which the back of a sheet becomes its front
constexpr double kOff = 1e-7; // [-] tip radii off the surface: in it, rounding would say which side
constexpr double kCorner = 0.4; // [-] of the least reach: the corner where the contact is wider
constexpr double kFlat = 0.05;  // [rad] of tilt over which a flat end comes to stand on its rim
constexpr double kBent = 0.3;   // [-] how near a place may come to where a hollow focuses

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

// @param apart  from the nearest point, whatever side it is on [m]
Neighborhood look(const Surface& surface, const BallRule& rule, const Eigen::Vector3d& position,
  double distance, double apart) noexcept
{
  const BallSize size = rule(distance);
  const double radius = size.smoothing.value;
  const double side = radius > 0.0 ? std::clamp(distance / radius, -1.0, 1.0) : 0.0;
  const PatchBall ball{ position, std::sqrt(size.squared.value), side, std::max(radius, 1e-9) };
  const double inside =
    surface.closed() ? (distance < 0.0 ? 1.0 : 0.0) : smoothStep(0.5 - 0.5 * distance / apart);
  return { distance, size, ball, patchWithin(surface, ball, inside) };
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
Eigen::Vector3d shareSlope(const Surface& surface, const Neighborhood& here) noexcept
{
  const PatchSlopes slopes = slopesWithin(surface, here.ball);
  const Patch& patch = here.patch;
  const Eigen::Vector3d normal = patch.normal.normalized();
  const Eigen::Vector3d wider = here.size.squared.slope * normal; // of Q
  const Eigen::Vector3d length =
    slopes.normal.transpose() * normal + normal.dot(patch.area) * wider;
  const Eigen::Vector3d weight = slopes.weight + slopes.area * wider;
  return (length - (1.0 - spreadOf(patch)) * weight) / patch.weight;
}

// Part of the curvature that is below the tool, where a coarse mesh tells it over a wider ball: a
// sphere's normals spread by at least twice as much as from where all of it counts.
double curvedPart(const Patch& patch, double curvature, double smoothing) noexcept
{
  const double spread = spreadOf(patch);
  const double ofSphere = curvature * curvature * smoothing * smoothing / 6.0;
  return 2.0 * spread < ofSphere ? smoothStep(std::max(0.0, 2.0 * spread / ofSphere)) : 1.0;
}

// How fast the normal below a place turns as that moves: the tensor T of curvature at a height h,
// T / (1 + h T).
class TurnRate
{
public:
  TurnRate(const LocalShape& shape, double height) noexcept
    : shape_(&shape)
  {
    const auto rate = [height](double curvature)
    { return curvature / std::max(kBent, 1.0 + height * curvature); };
    const double most = rate(shape.meanCurvature + shape.curvatureSpread);
    const double least = rate(shape.meanCurvature - shape.curvatureSpread);
    mean_ = 0.5 * (most + least);
    share_ = shape.curvatureSpread > 0.0 ? 0.5 * (most - least) / shape.curvatureSpread : 0.0;
  }

  // along a vector across the normal
  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& along) const noexcept
  {
    return mean_ * along + share_ * (shape_->bend * along - shape_->meanCurvature * along);
  }

private:
  const LocalShape* shape_;
  double mean_;
  double share_;
};

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
  const TurnRate turn(shape, height.value);
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
  contact.tiltSlope = turn(lean) / std::max(lean.norm(), 1e-9);
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
    outward -= std::max(0.0, here->ball.side) * part.slope * depth * shareSlope(surface, *here);
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
