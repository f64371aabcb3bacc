#include "haptics/surface/local_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp
{

ShapeAverage::ShapeAverage(const Eigen::Vector3d& normal, double radius) noexcept
  : radius_(radius)
  , normal_(normal.cast<float>())
  , u_(normal_.unitOrthogonal())
  , v_(normal_.cross(u_))
{
}

void ShapeAverage::add(const ShapePart& part, float root, const Eigen::Vector3f& offset) noexcept
{
  const float across = normal_.dot(part.area);
  if (!(across > 0.0F))
  {
    return;
  }
  const float weight = root * root;
  const float facing = across / part.area.norm();
  const Eigen::Vector3f alongU = part.bend * u_;
  const Eigen::Vector3f alongV = part.bend * v_;
  const float uu = u_.dot(alongU);
  const float vv = v_.dot(alongV);
  Eigen::Matrix<float, 5, 1> what;
  what << across, facing * 0.5F * (uu + vv), facing * 0.5F * (uu - vv), facing * u_.dot(alongV),
    facing * part.slenderness;
  Eigen::Matrix<float, 8, 1> how;
  how << weight, root * offset, root * (1.0F - root),
    weight / across * Eigen::Vector2f(u_.dot(part.area), v_.dot(part.area)), 0.0F;
  sums_ += how * what.transpose();
  lean_ += weight * facing * Eigen::Vector2f(normal_.dot(alongU), normal_.dot(alongV));
  hollow_ += weight * facing * part.hollow;
}

double ShapeAverage::mean(Eigen::Index of) const noexcept
{
  return static_cast<double>(sums_(0, of)) / static_cast<double>(sums_(0, 0));
}

// turning: what the tensor adds as u and v turn with the normal
LocalShape::Slope ShapeAverage::slope(
  Eigen::Index of, const Eigen::Vector2d& turning) const noexcept
{
  const auto area = static_cast<double>(sums_(0, 0));
  const Eigen::Matrix<double, 8, 1> change =
    (sums_.col(of).cast<double>() - mean(of) * sums_.col(0).cast<double>()) / area;
  const Eigen::Vector2d turned = change.segment<2>(5) - turning / area;
  return { .place = 4.0 / (radius_ * radius_) * change.segment<3>(1),
    .radius = 4.0 / radius_ * change[4],
    .normal = turned[0] * u_.cast<double>() + turned[1] * v_.cast<double>() };
}

LocalShape ShapeAverage::shape() const noexcept
{
  if (!(sums_(0, 0) > 0.0F))
  {
    return {};
  }
  const Eigen::Vector2d lean = lean_.cast<double>();
  const double difference = mean(2);
  const double mixed = mean(3);
  LocalShape shape;
  shape.meanCurvature = mean(1);
  shape.meanCurvatureSlope = slope(1, lean);
  shape.curvatureSpread = std::hypot(difference, mixed);
  const LocalShape::Slope first = slope(2, { lean[0], -lean[1] });
  const LocalShape::Slope second = slope(3, { lean[1], lean[0] });
  const double spread = std::max(shape.curvatureSpread, 1e-9);
  shape.curvatureSpreadSlope = { (difference * first.place + mixed * second.place) / spread,
    (difference * first.radius + mixed * second.radius) / spread,
    (difference * first.normal + mixed * second.normal) / spread };
  const double slender = mean(4);
  shape.thickness = 1.0 / (slender * slender);
  const LocalShape::Slope thinner = slope(4, Eigen::Vector2d::Zero());
  if (std::isfinite(shape.thickness)) // else it does not change
  {
    const double factor = -2.0 * shape.thickness / slender;
    shape.thicknessSlope = { factor * thinner.place, factor * thinner.radius,
      factor * thinner.normal };
  }
  shape.hollow = static_cast<double>(hollow_) / static_cast<double>(sums_(0, 0));
  return shape;
}

} // namespace palp
