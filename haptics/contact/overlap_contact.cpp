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
#include <utility>

namespace palp
{
namespace
{

constexpr double kSteepestSlope = 4.9; // [-] most of a slope of a tool without a round nose
constexpr double kFacing = 0.1; // [-] cosine over which the back of a sheet becomes its front

// What below a punch counts as its shape: about the middle of its flat and along its axis, whatever
// of the body the flat meets, which comes in and goes out at once.
void measureBelowFlat(Contact& contact, const Surface& surface, const Tip& tip,
  const ToolPose& pose, const Overlap& all, CurvatureOf of) noexcept
{
  const Eigen::Vector3d upward = -pose.axis;
  const double area = std::numbers::pi * flatRadius(tip) * flatRadius(tip);
  const Eigen::Vector3d sinking = ToolFrame(pose).axes * all.area / area;
  const Sloped wide = shapeRadius(surface, tip, { flatRadius(tip) });
  const ShapeBall ball{ pose.apex + all.volume / area * upward, wide.value, Eigen::Vector3d::Zero(),
    Eigen::Matrix3d::Identity() - upward * sinking.transpose() };
  const Eigen::Vector3d normal = std::exchange(contact.bodyNormal, upward);
  const Eigen::Matrix3d turning = std::exchange(contact.turning, Eigen::Matrix3d::Zero());
  measureShape(contact, surface, tip, ball, of);
  contact.bodyNormal = normal;
  contact.turning = turning;
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
  const auto measure = [&](CurvatureOf what)
  {
    solid.isPunch() ? measureBelowFlat(contact, surface, tip, pose, all, what)
                    : measureShape(contact, surface, tip, ball, what);
  };
  measure(CurvatureOf::Faces);
  const double round = contact.surfaceCurvature; // without edges
  const Immersion deep = solid.isPunch()
    ? flatImmersionOf(solid.flatRadius(), all.lift, round)
    : immersionOf(solid, upward, all.volume, flat.depth, round);
  contact.height = -deep.depth;
  contact.rising = deep.byVolume * falling + deep.byLift * (axes * all.liftArea) -
    deep.byCurvature * contact.curvatureSlope - turned(deep.byNormal);
  if (of == CurvatureOf::All)
  {
    measure(of);
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
