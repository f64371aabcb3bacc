#include "haptics/force/linear/contact_pressure.h"

#include "haptics/force/linear/contact_depth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr int kIntervals = 64;
constexpr double kNearEnd = 0.02; // [-] of the contact radius

// integral of g'(x) / sqrt(x^2 - radius^2) over x from radius to the contact's edge; with
// x^2 = radius^2 + s^2 the root is gone, and midpoints keep away from the end at x = 0
double shapeAt(const Tip& tip, double radius, double contactRadius)
{
  const double end = std::sqrt(std::max(0.0, contactRadius * contactRadius - radius * radius));
  const double step = end / kIntervals;
  const double small = 1e-4 * contactRadius;
  double sum = 0.0;
  for (int i = 0; i < kIntervals; ++i)
  {
    const double s = (i + 0.5) * step;
    const double x = std::sqrt(radius * radius + s * s);
    const double low = std::max(0.0, x - small);
    const double high = std::min(contactRadius, x + small);
    const double slope = (contactDepth(tip, high) - contactDepth(tip, low)) / (high - low);
    sum += slope / x * step;
  }
  return std::isfinite(sum) ? sum : 0.0;
}

} // namespace

ContactPressure::ContactPressure(const Tip& tip, double depth, double contactRadius, double force)
{
  if (!(contactRadius > 0.0) || !(force > 0.0) || !std::isfinite(depth))
  {
    return;
  }
  contactRadius_ = contactRadius;
  // a tip pressed in past its base goes on as a flat punch
  const bool atBase = contactRadius >= baseRadius(tip) * (1.0 - 1e-9);
  const double atEdge = atBase ? contactDepth(tip, contactRadius * (1.0 - 1e-6)) : depth;
  const double flat = atBase ? std::max(0.0, depth - atEdge) : 0.0;

  const double quarter = 0.5 * std::numbers::pi;
  double total = 0.0;
  for (std::size_t i = 0; i < kRows; ++i)
  {
    const double angle = quarter * static_cast<double>(i) / (kRows - 1);
    const double radius = std::max(kNearEnd, std::sin(angle)) * contactRadius;
    const double left = std::max(kNearEnd, std::cos(angle)) * contactRadius;
    pressure_[i] = shapeAt(tip, radius, contactRadius) + flat / left;
    // p 2 pi radius dradius by the trapezium rule in the angle
    const double weight = (i == 0 || i + 1 == kRows ? 0.5 : 1.0) * quarter / (kRows - 1);
    total += weight * pressure_[i] * 2.0 * std::numbers::pi * contactRadius * contactRadius *
      std::sin(angle) * std::cos(angle);
  }
  for (double& pressure : pressure_)
  {
    pressure *= total > 0.0 ? force / total : 0.0;
  }
}

double ContactPressure::at(double radius) const noexcept
{
  if (!(radius >= 0.0) || !(radius < contactRadius_))
  {
    return 0.0;
  }
  const double at = std::asin(radius / contactRadius_) * 2.0 / std::numbers::pi * (kRows - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kRows - 2);
  const double t = at - static_cast<double>(below);
  return pressure_[below] + t * (pressure_[below + 1] - pressure_[below]);
}

} // namespace palp
