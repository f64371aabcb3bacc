#include "haptics/contact/contact_shape.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kUpright = 1e-9; // [-]
constexpr double kGrain = 0.25;   // [-] tip radii of the sums that stand for a part of the contact
constexpr double kFinest = 2.0;   // [-] such sums across the least contact
constexpr double kCorner = 0.4;   // [-] of the least reach: the corner where the contact is wider

double grainOf(const Tip& tip) noexcept
{
  return kGrain * (noseRadius(tip) + flatRadius(tip));
}

} // namespace

Eigen::Vector3d NormalSum::shareSlope() const noexcept
{
  const Eigen::Vector3d length = slope.transpose() * value.normalized();
  return (length - (1.0 - spread()) * weightSlope) / weight;
}

Sloped shapeRadius(const Surface& surface, const Tip& tip, const Sloped& contact) noexcept
{
  const double least = std::max(surface.shape().finest(), kFinest * grainOf(tip));
  return smoothMax(contact, { least }, kCorner * least);
}

void measureNormal(Contact& contact, const ToolPose& pose, const NormalSum& normals) noexcept
{
  const Eigen::Vector3d normal = normals.value.normalized();
  contact.normalSpread = std::acos(std::min(1.0, 1.0 - normals.spread()));
  contact.bodyNormal = normal;
  contact.turning =
    (normals.slope - normal * (normal.transpose() * normals.slope)) / normals.value.norm();
  const Eigen::Vector3d lean = pose.axis - pose.axis.dot(normal) * normal;
  contact.tiltSlope = contact.turning.transpose() * lean / std::max(lean.norm(), kUpright);
}

void measureShape(Contact& contact, const Surface& surface, const Tip& tip, const ShapeBall& ball,
  CurvatureOf of) noexcept
{
  const LocalShape shape = surface.shape()(ball.center, ball.radius, ball.normal, grainOf(tip), of);
  const auto slopeOf = [&](const LocalShape::Slope& one)
  {
    return Eigen::Vector3d(ball.moving.transpose() * one.place + one.radius * ball.widening +
      ball.turning.transpose() * one.normal);
  };
  contact.surfaceCurvature = shape.meanCurvature;
  contact.curvatureSpread = shape.curvatureSpread;
  contact.thickness = shape.thickness;
  contact.hollow = shape.hollow;
  contact.curvatureSlope = slopeOf(shape.meanCurvatureSlope);
  contact.spreadSlope = slopeOf(shape.curvatureSpreadSlope);
  contact.thicknessSlope = slopeOf(shape.thicknessSlope);
}

} // namespace palp
