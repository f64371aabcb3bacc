#include "haptics/contact/overlap_contact.h"

#include "haptics/contact/contact_shape.h"
#include "haptics/contact/overlap/flat_end.h"
#include "haptics/contact/overlap/immersion.h"
#include "haptics/contact/overlap/overlap.h"
#include "haptics/numerics/smooth_step.h"
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

// Part of a hollow that is one, and no step between floors that a flat meets: in one a radius wide
// the normals spread.
CountedPart hollowPart(const NormalSum& normals, const Contact& contact, double radius) noexcept
{
  const double curvature = contact.surfaceCurvature;
  const double ofHollow = 0.25 * curvature * curvature * radius * radius;
  const double entered = normals.spread() / ofHollow;
  if (!(curvature < 0.0 && entered < 1.0))
  {
    return {};
  }
  return { smoothStep(entered),
    -6.0 * entered * (1.0 - entered) *
      (normals.shareSlope() / ofHollow + 2.0 * entered / curvature * contact.curvatureSlope) };
}

} // namespace

Contact overlapContact(
  const Surface& surface, const Tip& tip, const ToolPose& pose, CurvatureOf of) noexcept
{
  const ToolSolid solid(tip);
  const ToolFrame frame(pose);
  const auto& axes = frame.axes;
  const Overlap all = overlapOf(surface, solid, frame);
  if (!(all.volume > 0.0 && all.weight > 0.0))
  {
    return {};
  }
  const NormalSum normals{ axes * all.normal, axes * all.normalSlope * axes.transpose(), all.weight,
    axes * all.weightSlope };
  const Eigen::Vector3d upward = all.normal.normalized(); // as the tool sees it
  Contact contact;
  measureNormal(contact, pose, normals);
  const auto turned = [&](const Eigen::Vector3d& byNormal)
  { return Eigen::Vector3d(contact.turning.transpose() * (axes * byNormal)); };
  const Eigen::Vector3d falling = axes * all.area;
  const Immersion flat = immersionOf(solid, upward, all.volume, all.volume / all.weight, 0.0);
  const Sloped wide = shapeRadius(surface, tip, solid.radiusAt(flat.depth));
  const Eigen::Vector3d place = all.place / all.weight;
  const ShapeBall ball{ frame.apex + axes * place, wide.value,
    wide.slope * (turned(flat.byNormal) - flat.byVolume * falling),
    axes * (all.placeSlope - place * all.weightSlope.transpose()) / all.weight * axes.transpose() };
  measureShape(contact, surface, tip, ball, CurvatureOf::Faces);
  const CountedPart hollow =
    solid.isPunch() ? hollowPart(normals, contact, solid.flatRadius()) : CountedPart{};
  const double round = hollow.value * contact.surfaceCurvature; // without edges
  const Eigen::Vector3d rounding =
    hollow.value * contact.curvatureSlope + contact.surfaceCurvature * hollow.slope;
  const Immersion deep = solid.isPunch()
    ? flatImmersionOf(solid.flatRadius(), all.lift, round)
    : immersionOf(solid, upward, all.volume, flat.depth, round);
  contact.height = -deep.depth;
  contact.rising = deep.byVolume * falling + deep.byLift * (axes * all.liftArea) -
    deep.byCurvature * rounding - turned(deep.byNormal);
  if (of == CurvatureOf::All)
  {
    measureShape(contact, surface, tip, ball, of);
  }
  contact.tilt = std::acos(std::clamp(upward.z(), -1.0, 1.0));
  const double front = surface.closed() ? 1.0 : std::min(1.0, upward.z() / kFacing);
  contact.depth = front * deep.depth;
  const Eigen::Vector3d outward = front * contact.rising;
  // by more only at the very end of a pin's contact, and where triangles are missing or turned over
  contact.slope = std::min(outward.norm(), kSteepestSlope);
  contact.normal = outward.normalized();
  // the middle of what is in the tool, from that of a plane below the apex, and up to a round top
  const Eigen::Vector3d foot =
    axes * (place - deep.aside) + 0.25 / std::numbers::pi * deep.area * round * contact.bodyNormal;
  contact.center = frame.apex + foot;
  contact.relief = foot.dot(contact.bodyNormal) - deep.depth;
  contact.triangle =
    findClosestPoint(surface, contact.center, std::numeric_limits<double>::infinity()).triangle;
  return contact;
}

} // namespace palp
