#include "haptics/force/tip.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kSteepest = 1e6; // [-], stands for the vertical flank of a sphere's equator

double cot(double angle) noexcept
{
  return 1.0 / std::tan(angle);
}

// height and slope of a spherical cap
double capHeight(double sphereRadius, double radius) noexcept
{
  // r^2 / (R + sqrt(R^2 - r^2)) keeps its digits near the apex, R - sqrt(R^2 - r^2) does not
  const double rest = std::max(0.0, sphereRadius * sphereRadius - radius * radius);
  return radius * radius / (sphereRadius + std::sqrt(rest));
}

double capSlope(double sphereRadius, double radius) noexcept
{
  const double rest = std::max(0.0, sphereRadius * sphereRadius - radius * radius);
  return radius < kSteepest * std::sqrt(rest) ? radius / std::sqrt(rest) : kSteepest;
}

double base(const SphereTip& tip) noexcept { return tip.radius; }
double base(const ConeTip& tip) noexcept { return tip.baseRadius; }
double base(const PunchTip& tip) noexcept { return tip.radius; }
double base(const TruncatedConeTip& tip) noexcept { return tip.baseRadius; }
double base(const BluntConeTip& tip) noexcept { return tip.baseRadius; }
double base(const ParaboloidTip& tip) noexcept { return tip.radius; }

double height(const SphereTip& tip, double r) noexcept { return capHeight(tip.radius, r); }
double height(const ConeTip& tip, double r) noexcept { return r * cot(tip.halfAngle); }
double height(const PunchTip&, double) noexcept { return 0.0; }
double height(const TruncatedConeTip& tip, double r) noexcept
{
  return std::max(0.0, r - tip.flatRadius) * cot(tip.halfAngle);
}
double height(const BluntConeTip& tip, double r) noexcept
{
  const double tangent = tip.tipRadius * std::cos(tip.halfAngle);
  const double onCap = std::min(r, tangent);
  return capHeight(tip.tipRadius, onCap) + (r - onCap) * cot(tip.halfAngle);
}
double height(const ParaboloidTip& tip, double r) noexcept { return r * r / (2.0 * tip.radius); }

double slope(const SphereTip& tip, double r) noexcept { return capSlope(tip.radius, r); }
double slope(const ConeTip& tip, double) noexcept { return cot(tip.halfAngle); }
double slope(const PunchTip&, double) noexcept { return 0.0; }
double slope(const TruncatedConeTip& tip, double r) noexcept
{
  return r > tip.flatRadius ? cot(tip.halfAngle) : 0.0;
}
double slope(const BluntConeTip& tip, double r) noexcept
{
  const double tangent = tip.tipRadius * std::cos(tip.halfAngle);
  return r < tangent ? capSlope(tip.tipRadius, r) : cot(tip.halfAngle);
}
double slope(const ParaboloidTip& tip, double r) noexcept { return r / tip.radius; }

// get_if for each alternative in turn, because visit may throw and the servo thread may not
template <typename Function>
double onTip(const Tip& tip, Function function) noexcept
{
  if (const auto* sphere = std::get_if<SphereTip>(&tip))
  {
    return function(*sphere);
  }
  if (const auto* cone = std::get_if<ConeTip>(&tip))
  {
    return function(*cone);
  }
  if (const auto* punch = std::get_if<PunchTip>(&tip))
  {
    return function(*punch);
  }
  if (const auto* truncated = std::get_if<TruncatedConeTip>(&tip))
  {
    return function(*truncated);
  }
  if (const auto* blunt = std::get_if<BluntConeTip>(&tip))
  {
    return function(*blunt);
  }
  if (const auto* paraboloid = std::get_if<ParaboloidTip>(&tip))
  {
    return function(*paraboloid);
  }
  return 0.0; // ProfileTip: with the profile itself
}

} // namespace

double baseRadius(const Tip& tip) noexcept
{
  return onTip(tip, [](const auto& shape) { return base(shape); });
}

double tipHeight(const Tip& tip, double radius) noexcept
{
  const double r = std::min(radius, baseRadius(tip));
  return onTip(tip, [r](const auto& shape) { return height(shape, r); });
}

double tipSlope(const Tip& tip, double radius) noexcept
{
  const double r = std::min(radius, baseRadius(tip));
  return onTip(tip, [r](const auto& shape) { return slope(shape, r); });
}

Tip checkedTip(Tip tip)
{
  return tip;
}

} // namespace palp
