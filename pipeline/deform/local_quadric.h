#pragma once

#include "pipeline/deform/press_region.h"

#include <Eigen/Core>

namespace palp
{

/// The undeformed surface around a contact as a quadric over its tangent plane.
class LocalQuadric
{
public:
  /// Least squares over the points that face the tool, weighted so that none enters with a jump,
  /// neither with its distance nor as it turns to the tool.
  ///
  /// @param reach  radius within which points count [m]
  void fit(const PressRegion& region, double reach);

  /// Height over the tangent plane [m].
  [[nodiscard]] double height(double x, double y) const noexcept
  {
    const Coefficients& c = coefficients_;
    return c[0] + x * (c[1] + x * c[3] + y * c[4]) + y * (c[2] + y * c[5]);
  }

  [[nodiscard]] double reach() const noexcept
  {
    return reach_;
  }

private:
  // z = c0 + c1 x + c2 y + c3 x^2 + c4 xy + c5 y^2
  using Coefficients = Eigen::Matrix<double, 6, 1>;

  Coefficients coefficients_ = Coefficients::Zero();
  double reach_ = 0.0; // [m]
};

} // namespace palp
