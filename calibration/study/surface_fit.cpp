#include "calibration/study/surface_fit.h"

#include "haptics/error.h"

#include <Eigen/QR>

namespace palp::fem
{

SurfaceProfile fitSurface(const IndentationStep& pressed, const Tip& tip)
{
  const auto& points = pressed.profile;
  SurfaceProfile curve;
  curve.inner = pressed.contactRadius;
  curve.outer = points.empty() ? 0.0 : points.back().radius + points.back().ur;
  curve.sink = pressed.depth - tipHeight(tip, curve.inner);
  curve.slope = tipSlope(tip, curve.inner);

  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(count, 2);
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(count);
  int outside = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const double radius = points[i].radius + points[i].ur;
    if (radius <= curve.inner || radius >= curve.outer)
    {
      continue;
    }
    ++outside;
    const double fraction = std::sqrt(radius - points[i - 1].radius - points[i - 1].ur);
    const auto b = SurfaceProfile::bernstein(curve.parameter(radius));
    const auto row = static_cast<Eigen::Index>(i);
    weights.row(row) << fraction * b[2], fraction * b[3];
    rest[row] = fraction * (-points[i].uz - b[4] * curve.lastButOne() - b[5] * curve.sink);
  }
  if (outside < 8)
  {
    throw Error(ErrorCode::BadValue,
      "surface: fewer than eight points outside the contact; take a finer mesh");
  }
  const Eigen::Vector2d control = weights.colPivHouseholderQr().solve(rest);
  curve.control = { control[0], control[1] };
  return curve;
}

double paperSink(
  const Tip& tip, double depth, double contactRadius, double extentRadius, double radius)
{
  const double sink = depth - tipHeight(tip, contactRadius);
  const double slope = tipSlope(tip, contactRadius);
  const double outer = std::max(extentRadius, 1.2 * contactRadius);
  const double meet = std::clamp(contactRadius + sink / slope, contactRadius, outer);
  if (radius >= outer)
  {
    return 0.0;
  }
  const double first = meet - contactRadius;
  const double bend = contactRadius - 2.0 * meet + outer;
  const double rise = radius - contactRadius;
  const double u = rise / (first + std::sqrt(std::max(0.0, first * first + bend * rise)));
  return sink * (1.0 - u) * (1.0 - u);
}

} // namespace palp::fem
