#include "haptics/contact/overlap_contact.h"

#include "haptics/contact/contact_shape.h"
#include "haptics/contact/overlap/flat_end.h"
#include "haptics/contact/overlap/immersion.h"
#include "haptics/contact/overlap/overlap.h"
#include "haptics/surface/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kSteepestSlope = 4.9; // [-] most of a slope of a tool without a round nose
constexpr double kFacing = 0.1; // [-] cosine over which the back of a sheet becomes its front

// from the apex up to where a tool leaves an even body; not above 0 where it is outside [m]
double insideOf(const Surface& surface, const ToolPose& pose) noexcept
{
  constexpr double kLeast = 0.5; // [-] cosine
  const ClosestPoint nearest =
    findClosestPoint(surface, pose.apex, std::numeric_limits<double>::infinity());
  const double cosine = (pose.apex - nearest.point).normalized().dot(pose.axis);
  return -nearest.distance / std::max(kLeast, cosine);
}

// What below a flat counts as its shape: about its middle and along its axis, whatever of the body
// the flat meets, which comes in and goes out at once.
ShapeBall belowFlat(const ToolFrame& frame, const Immersion& flat, const Sloped& wide,
  const Eigen::Vector3d& sinking) noexcept
{
  const Eigen::Vector3d upward = frame.axes.col(2);
  return { .center = frame.apex + flat.depth * upward,
    .radius = wide.value,
    .normal = upward,
    .widening = wide.slope * sinking,
    .moving = Eigen::Matrix3d::Identity() + upward * sinking.transpose() };
}

// Of other tools: about the middle of what the body has in them, as wide as the contact there.
ShapeBall belowMiddle(const ToolFrame& frame, const Overlap& all, const Contact& contact,
  const Sloped& wide, const Eigen::Vector3d& sinking) noexcept
{
  const auto& axes = frame.axes;
  const Eigen::Vector3d place = all.place / all.weight;
  return { .center = frame.apex + axes * place,
    .radius = wide.value,
    .normal = contact.bodyNormal,
    .widening = wide.slope * sinking,
    .moving =
      axes * (all.placeSlope - place * all.weightSlope.transpose()) / all.weight * axes.transpose(),
    .turning = contact.turning };
}

} // namespace

Contact overlapContact(
  const Surface& surface, const Tip& tip, const ToolPose& pose, CurvatureOf of) noexcept
{
  ToolSolid solid(tip);
  const ToolFrame frame(pose);
  const auto& axes = frame.axes;
  Overlap all = overlapOf(surface, solid, frame);
  if (all.isBeyond) // another part of the body, or the tool is as deep in it
  {
    solid = ToolSolid(tip, insideOf(surface, pose));
    all = overlapOf(surface, solid, frame);
  }
  const bool isFlat = solid.isFlat();
  if (!((isFlat ? all.lift : all.volume) > 0.0 && all.weight > 0.0))
  {
    return {};
  }
  const NormalSum normals{ axes * all.normal, axes * all.normalSlope * axes.transpose(), all.weight,
    axes * all.weightSlope };
  const Eigen::Vector3d upward = all.normal.normalized(); // as the tool sees it
  Contact contact;
  measureNormal(contact, pose, normals);
  const auto immersed = [&](double start, double curvature)
  {
    return isFlat ? flatImmersionOf(solid, all.lift, curvature)
                  : immersionOf(solid, upward, all.volume, start, curvature);
  };
  const auto sinkingOf = [&](const Immersion& in)
  {
    return Eigen::Vector3d(contact.turning.transpose() * (axes * in.byNormal) -
      axes * (in.byVolume * all.area + in.byLift * all.liftArea));
  };
  const Immersion plane = immersed(all.volume / all.weight, 0.0);
  const Sloped wide = shapeRadius(surface, tip, solid.radiusAt(plane.depth));
  const Eigen::Vector3d sinking = sinkingOf(plane);
  const ShapeBall below = isFlat ? belowFlat(frame, plane, wide, sinking)
                                 : belowMiddle(frame, all, contact, wide, sinking);
  measureShape(contact, surface, tip, below, CurvatureOf::Faces);
  const double round = contact.surfaceCurvature; // without edges
  const Immersion deep = immersed(plane.depth, round);
  contact.height = -deep.depth;
  contact.rising = -sinkingOf(deep) - deep.byCurvature * contact.curvatureSlope;
  if (of == CurvatureOf::All)
  {
    measureShape(contact, surface, tip, below, of);
  }
  contact.tilt = std::acos(std::clamp(upward.z(), -1.0, 1.0));
  const double front = surface.closed() ? 1.0 : std::min(1.0, upward.z() / kFacing);
  contact.depth = front * deep.depth;
  const Eigen::Vector3d outward = front * contact.rising;
  // by more only at the very end of a pin's contact, and where triangles are missing or turned over
  contact.slope = std::min(outward.norm(), kSteepestSlope);
  contact.normal = outward.normalized();
  // the middle of what is in the tool, from that of a plane below the apex, and up to a round top
  const Eigen::Vector3d foot = axes * (all.place / all.weight - deep.aside) +
    0.25 / std::numbers::pi * deep.area * round * contact.bodyNormal;
  contact.center = frame.apex + foot;
  contact.relief = foot.dot(contact.bodyNormal) - deep.depth;
  contact.triangle =
    findClosestPoint(surface, contact.center, std::numeric_limits<double>::infinity()).triangle;
  return contact;
}

} // namespace palp
