#include "haptics/force/ellipse.h"

#include "haptics/numerics/monotone_cubic.h"
#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{

EllipseFactor::EllipseFactor()
  : spreads_{ 0.0 }
  , factors_{ 1.0 }
{
  // b / a falls from 1; e is the eccentricity, K and E are the complete elliptic integrals of e
  for (int i = 1; spreads_.back() < kSlimmest; ++i)
  {
    const double aspect = std::pow(0.95, i); // b / a
    const double e2 = 1.0 - aspect * aspect;
    const double k = std::comp_ellint_1(std::sqrt(e2));
    const double e = std::comp_ellint_2(std::sqrt(e2));
    const double ratio = (k - e) / (e / (aspect * aspect) - k); // A / B
    const double fraction = ratio / (1.0 + ratio);              // A / (A + B)
    spreads_.push_back(1.0 - 2.0 * fraction);
    factors_.push_back(0.5 * std::numbers::pi / k * std::sqrt((k - e) / (fraction * e2 * k)));
  }
  slopes_ = monotoneSlopes(spreads_, factors_);
}

double EllipseFactor::operator()(double spread) const noexcept
{
  constexpr double kLeveled = 0.01; // about the end, for the slope of the factor is a force
  const double leveled = smoothMin(std::max(0.0, spread), kSlimmest - kLeveled, kLeveled);
  return cubicAt(spreads_, factors_, slopes_, leveled).value;
}

} // namespace palp
