#include "haptics/force/linear/contact_depth.h"

#include "haptics/tip/profile.h"

#include <numbers>

namespace palp
{
namespace
{

double contactDepth(const ConeTip& tip, double a) noexcept
{
  return 0.5 * std::numbers::pi * a * cot(tip.halfAngle);
}

double contactDepth(const PunchTip&, double) noexcept
{
  return 0.0;
}

double contactDepth(const TruncatedConeTip& tip, double a) noexcept
{
  return a > tip.flatRadius ? a * cot(tip.halfAngle) * std::acos(tip.flatRadius / a) : 0.0;
}

double contactDepth(const BluntConeTip& tip, double a) noexcept
{
  const CappedCone cone(tip);
  return a > cone.b ? a * cone.steepness(a) : contactDepth(SphereTip{ cone.rho }, a);
}

double contactDepth(const ParaboloidTip& tip, double a) noexcept
{
  return a * a / tip.radius;
}

double contactDepth(const ProfileTip& tip, double a) noexcept
{
  return tip.profile->contactDepth(a);
}

} // namespace

double contactDepth(const Tip& tip, double radius) noexcept
{
  return onTip(tip, [radius](const auto& shape) { return contactDepth(shape, radius); });
}

} // namespace palp
