#include "calibration/organ/smooth_pressure.h"

#include <cmath>
#include <numbers>

namespace palp
{

double SmoothPressure::at(double distance) const noexcept
{
  return 2.5 * std::pow(radius, 5) / (std::numbers::pi * std::pow(std::hypot(distance, radius), 7));
}

double SmoothPressure::radiusOf(double part) const noexcept
{
  return radius * std::sqrt(std::pow(1.0 - part, -0.4) - 1.0);
}

Eigen::Vector3d SmoothPressure::displacement(const Eigen::Vector3d& place) const noexcept
{
  const double c = radius;
  const double z = place.z() + c;
  const double r = std::hypot(place.x(), place.y(), z);
  const double r3 = r * r * r;
  const double r5 = r3 * r * r;
  const double r7 = r5 * r * r;
  // the potential V, its slopes along the surface over the distance and down, that of its integral
  const double v = 1.0 / r + c * z / r3 - c * c / 3.0 * (1.0 / r3 - 3.0 * z * z / r5);
  const double vAlong = -1.0 / r3 - 3.0 * c * z / r5 + c * c * (1.0 / r5 - 5.0 * z * z / r7);
  const double vDown = (c - z) / r3 + 3.0 * c * z * (c - z) / r5 - 5.0 * c * c * z * z * z / r7;
  const double hAlong = 1.0 / (r * (r + z)) + c / r3 + c * c * z / r5;
  const double aside = -(1.0 - 2.0 * poisson) * hAlong - place.z() * vAlong;
  const double down = 2.0 * (1.0 - poisson) * v - place.z() * vDown;
  return Eigen::Vector3d(aside * place.x(), aside * place.y(), down) /
    (4.0 * std::numbers::pi * shear);
}

Eigen::Matrix3d SmoothPressure::stress(const Eigen::Vector3d& place) const noexcept
{
  const double step = 1e-4 * radius;
  Eigen::Matrix3d gradient;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d aside = step * Eigen::Vector3d::Unit(axis);
    gradient.col(axis) = (displacement(place + aside) - displacement(place - aside)) / (2.0 * step);
  }
  const double spherical = 2.0 * poisson / (1.0 - 2.0 * poisson) * gradient.trace();
  return shear * (gradient + gradient.transpose() + spherical * Eigen::Matrix3d::Identity());
}

} // namespace palp
