#include "calibration/organ/smooth_pressure.h"

#include "haptics/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr SmoothPressure kPressure{ .radius = 6.0_mm, .shear = 20e3, .poisson = 0.3 };

// Boussinesq's displacement of a surface, by a sum over rings and angles
TEST(SmoothPressure, MovesTheSurfaceAsBoussinesqSays)
{
  const double modulus = 2.0 * kPressure.shear / (1.0 - kPressure.poisson);
  for (const double distance : { 0.0, 5.0_mm, 8.01_mm, 13.0_mm, 300.0_mm })
  {
    double sum = 0.0;
    double force = 0.0;
    constexpr int rings = 3000;
    constexpr int angles = 800;
    constexpr double step = 50.0_mm / rings;
    for (int i = 0; i < rings; ++i)
    {
      const double r = step * (i + 0.5);
      const double part = kPressure.at(r) * r * step * 2.0 * std::numbers::pi / angles;
      force += part * angles;
      for (int j = 0; j < angles; ++j)
      {
        const double angle = 2.0 * std::numbers::pi * (j + 0.5) / angles;
        const double away = std::hypot(r * std::cos(angle) - distance, r * std::sin(angle));
        sum += part / (std::numbers::pi * modulus * away);
      }
    }
    EXPECT_NEAR(force, 1.0, 1e-3);
    EXPECT_NEAR(kPressure.displacement({ 0.0, distance, 0.0 }).z(), sum, 5e-3 * sum) << distance;
  }
}

// no force on any part of the half-space, its pressure and no shear on the surface
TEST(SmoothPressure, IsInBalance)
{
  for (const Vector3d& place :
    { Vector3d(1e-3, 2e-3, 3e-3), Vector3d(-8e-3, 5e-3, 1e-3), Vector3d(20e-3, -9e-3, 30e-3) })
  {
    Vector3d left = Vector3d::Zero();
    double size = 0.0;
    constexpr double step = 1e-4;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d aside = step * Vector3d::Unit(axis);
      const Vector3d change =
        (kPressure.stress(place + aside) - kPressure.stress(place - aside)).col(axis);
      left += change;
      size = std::max(size, change.norm());
    }
    EXPECT_LT(left.norm(), 1e-3 * size);
  }
  const Vector3d top = kPressure.stress({ 3.0_mm, 4.0_mm, 0.0 }).col(2);
  EXPECT_NEAR(top.z(), -kPressure.at(5.0_mm), 1e-5 * kPressure.at(5.0_mm));
  EXPECT_LT(top.head<2>().norm(), 1e-5 * kPressure.at(5.0_mm));
  for (const double part : { 0.1, 0.5, 0.99 })
  {
    double force = 0.0;
    const double step = kPressure.radiusOf(part) / 1000;
    for (int i = 0; i < 1000; ++i)
    {
      const double r = step * (i + 0.5);
      force += kPressure.at(r) * 2.0 * std::numbers::pi * r * step;
    }
    EXPECT_NEAR(force, part, 1e-4);
  }
}

} // namespace
} // namespace palp
