#include "haptics/contact/overlap/flat_end.h"

#include "haptics/numerics/leveled.h"

#include <cmath>
#include <numbers>

namespace palp
{

Immersion flatImmersionOf(double radius, double lift, double curvature) noexcept
{
  constexpr double turn = 2.0 * std::numbers::pi;
  const Leveled bent =
    curvature > 0.0 ? Leveled{ curvature, 1.0, 0.0 } : leveled(curvature, radius);
  const double square = radius * radius;
  const double area = 0.5 * turn * square;
  const double top = bent.value * square;   // twice what the body rises over the rim
  const double variance = top * top / 48.0; // of that rise
  const double squared = 2.0 * lift / area; // depth, in the mean
  if (squared > 4.0 * variance)
  {
    const double root = std::sqrt(squared - variance);
    return { .depth = 0.25 * top + root,
      .byLift = 1.0 / (area * root),
      .byCurvature = bent.slope * square * (0.25 - top / (48.0 * root)),
      .area = area };
  }
  // a cap, or in a hollow a ring, which is deepest at the rim
  const double deepest = std::cbrt(6.0 * std::abs(bent.value) * lift / turn);
  const bool isRing = bent.value < 0.0;
  return { .depth = deepest + (isRing ? 0.5 * top : 0.0),
    .byLift = deepest / (3.0 * lift),
    .byCurvature = bent.slope * (deepest / (3.0 * bent.value) + (isRing ? 0.5 * square : 0.0)),
    .area = turn * deepest / std::abs(bent.value) };
}

} // namespace palp
