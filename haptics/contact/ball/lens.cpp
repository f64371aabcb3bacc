#include "haptics/contact/ball/lens.h"

#include <cmath>
#include <numbers>

namespace palp
{

Lens lensOf(double squaredRadius, double height, double curvature) noexcept
{
  constexpr double turn = 2.0 * std::numbers::pi;
  constexpr double kThird = 1.0 / 3.0;
  const double q = squaredRadius;
  const double k = curvature;
  const double r = std::sqrt(q);
  const double a2 = height * height;
  const double a = std::abs(height);
  const double b = k * a2 + 2.0 * height;
  const double part = 0.5 / (1.0 + k * height); // 1 / c
  const double v = q - a2;
  // of (Q - s^2) s^n from a to r
  const double first = 0.25 * v * v;
  const double third = q * first - kThird * 0.5 * v * v * v;
  const double inner = a * a2 * (kThird * q - 0.2 * a2);
  const double second = 2.0 / 15.0 * q * q * r - inner;
  const double cut = (k * third + b * first) * part;
  Lens lens{};
  lens.moment = turn * (second - cut);
  const double byAngle = part / r;
  lens.volume = turn * (kThird * (q * r - a * a2) - 0.5 * v * part * (0.5 * k * (q + a2) + b));
  lens.solidAngle = turn * (1.0 - (k * q + b) * byAngle);
  lens.solidAngleSlope = -0.5 * turn * (k - b / q) * byAngle;
  if (height < 0.0)
  {
    lens.moment += 2.0 * turn * inner;
    lens.volume += 2.0 * kThird * turn * a * a2;
  }
  lens.heightSlope = -turn * (first - 2.0 * k * cut * part);
  lens.curvatureSlope = -turn * (third + a2 * first - 2.0 * height * cut) * part;
  return lens;
}

} // namespace palp
