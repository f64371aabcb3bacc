#include "haptics/force/inclination.h"

#include "haptics/numerics/monotone_cubic.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palp
{
namespace
{

using namespace units::literals;

// F / F upright of a cone of 45 degrees; slopes [1/rad] from the parabola through neighbors. Beyond
// 30 degrees it levels off, as nothing was compared there.
constexpr std::array kTilts{ 0.0, 3.0_deg, 6.0_deg, 9.0_deg, 12.0_deg, 15.0_deg, 20.0_deg, 25.0_deg,
  30.0_deg, 40.0_deg };
constexpr std::array kForces{ 1.0, 1.00465, 1.01936, 1.04452, 1.08136, 1.13222, 1.25745, 1.44984,
  1.71525, 2.0 };

// tilt at which the force is 7 % higher, at half angles of 30, 45 and 60 degrees
constexpr double kNarrow = 12.8_deg;
constexpr double kMiddle = 11.1_deg;
constexpr double kWide = 7.9_deg;

constexpr double slopeAt(std::size_t i) noexcept
{
  if (i == 0 || i + 1 == kTilts.size())
  {
    return 0.0; // tilting either way is the same, and nothing jumps where it is level
  }
  const double before = kTilts[i] - kTilts[i - 1];
  const double after = kTilts[i + 1] - kTilts[i];
  return ((kForces[i] - kForces[i - 1]) / before * after +
           (kForces[i + 1] - kForces[i]) / after * before) /
    (before + after);
}

constexpr auto kSlopes = []
{
  std::array<double, kTilts.size()> slopes{};
  for (std::size_t i = 0; i < slopes.size(); ++i)
  {
    slopes[i] = slopeAt(i);
  }
  return slopes;
}();

// tilt at which the force of a cone is 7 % higher: the parabola through the three half angles
double noticeableTilt(const ConeTip& cone) noexcept
{
  const double x = (std::clamp(cone.halfAngle, 30.0_deg, 60.0_deg) - 45.0_deg) / 15.0_deg;
  return kMiddle + 0.5 * x * (kWide - kNarrow) + 0.5 * x * x * (kWide + kNarrow - 2.0 * kMiddle);
}

} // namespace

InclinedForce inclinedForce(double force, double tilt) noexcept
{
  return { force * std::cos(tilt), force * std::sin(std::abs(tilt)) };
}

double tiltOfShare(double fraction) noexcept
{
  return std::acos(1.0 - fraction);
}

double tiltFactor(const Tip& tip, double tilt) noexcept
{
  const auto* cone = std::get_if<ConeTip>(&tip);
  if (cone == nullptr || !std::isfinite(tilt))
  {
    return 1.0;
  }
  const double scaledTilt = std::abs(tilt) * kMiddle / noticeableTilt(*cone);
  return cubicAt(kTilts, kForces, kSlopes, scaledTilt).value;
}

double tiltReach(const Tip& tip) noexcept
{
  const auto* cone = std::get_if<ConeTip>(&tip);
  if (cone == nullptr)
  {
    return 0.0;
  }
  // to which boundary elements were compared; a flank soon lies along the surface
  constexpr std::array angles{ 30.0_deg, 45.0_deg, 60.0_deg, 90.0_deg };
  constexpr std::array reaches{ 25.0_deg, 30.0_deg, 15.0_deg, 0.0 };
  const Bracket at = bracket(angles, cone->halfAngle);
  return reaches[at.low] + at.fraction * (reaches[at.low + 1] - reaches[at.low]);
}

} // namespace palp
