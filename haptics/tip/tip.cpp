#include "haptics/tip/tip.h"

#include "haptics/error.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kSteepest = 1e6; // [-], stands for the vertical flank of a sphere's equator

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

double base(const SphereTip& tip) noexcept
{
  return tip.radius;
}
double base(const ConeTip& tip) noexcept
{
  return tip.baseRadius;
}
double base(const PunchTip& tip) noexcept
{
  return tip.radius;
}
double base(const TruncatedConeTip& tip) noexcept
{
  return tip.baseRadius;
}
double base(const BluntConeTip& tip) noexcept
{
  return tip.baseRadius;
}
double base(const ParaboloidTip& tip) noexcept
{
  return tip.radius;
}
double base(const ProfileTip& tip) noexcept
{
  return tip.profile->baseRadius();
}

double height(const SphereTip& tip, double r) noexcept
{
  return capHeight(tip.radius, r);
}
double height(const ConeTip& tip, double r) noexcept
{
  return r * cot(tip.halfAngle);
}
double height(const PunchTip&, double) noexcept
{
  return 0.0;
}
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
double height(const ParaboloidTip& tip, double r) noexcept
{
  return r * r / (2.0 * tip.radius);
}
double height(const ProfileTip& tip, double r) noexcept
{
  return tip.profile->height(r);
}

double slope(const SphereTip& tip, double r) noexcept
{
  return capSlope(tip.radius, r);
}
double slope(const ConeTip& tip, double) noexcept
{
  return cot(tip.halfAngle);
}
double slope(const PunchTip&, double) noexcept
{
  return 0.0;
}
double slope(const TruncatedConeTip& tip, double r) noexcept
{
  return r > tip.flatRadius ? cot(tip.halfAngle) : 0.0;
}
double slope(const BluntConeTip& tip, double r) noexcept
{
  const double tangent = tip.tipRadius * std::cos(tip.halfAngle);
  return r < tangent ? capSlope(tip.tipRadius, r) : cot(tip.halfAngle);
}
double slope(const ParaboloidTip& tip, double r) noexcept
{
  return r / tip.radius;
}
double slope(const ProfileTip& tip, double r) noexcept
{
  return tip.profile->slope(r);
}

void checkRange(double value, double lowest, double highest, const char* what,
  double (*shown)(double), const char* unit)
{
  // written so that NaN, too, is refused; the slack is for rounding in the conversion of units
  constexpr double slack = 1e-12;
  if (!(value >= lowest * (1.0 - slack) && value <= highest * (1.0 + slack)))
  {
    std::ostringstream text;
    text << what << ": " << shown(value) << unit << "; give " << shown(lowest) << unit << " to "
         << shown(highest) << unit;
    throw Error(ErrorCode::BadValue, text.str());
  }
}

void checkLength(double value, double lowest, double highest, const char* what)
{
  checkRange(value, lowest, highest, what, units::toMillimeters, " mm");
}

void checkRadius(double value, const char* what)
{
  checkLength(value, 0.1_mm, 1000.0_mm, what);
}

void checkAngle(double value)
{
  checkRange(value, 1.0_deg, 89.0_deg, "angle between axis and flank", units::toDegrees, " deg");
}

void check(const SphereTip& tip)
{
  checkRadius(tip.radius, "radius of the sphere");
}
void check(const PunchTip& tip)
{
  checkRadius(tip.radius, "radius of the punch");
}
void check(const ParaboloidTip& tip)
{
  checkRadius(tip.radius, "radius of the paraboloid");
}
void check(const ConeTip& tip)
{
  checkAngle(tip.halfAngle);
  checkRadius(tip.baseRadius, "base radius of the cone");
}
void check(const TruncatedConeTip& tip)
{
  checkAngle(tip.halfAngle);
  checkRadius(tip.baseRadius, "base radius of the cone");
  checkLength(tip.flatRadius, 1.0_um, 0.999 * tip.baseRadius, "radius of the cone's flat");
}
void check(const BluntConeTip& tip)
{
  checkAngle(tip.halfAngle);
  checkRadius(tip.baseRadius, "base radius of the cone");
  checkLength(tip.tipRadius, 1.0_um, 0.999 * tip.baseRadius / std::cos(tip.halfAngle),
    "radius of the cone's tip");
}
void check(const ProfileTip& tip)
{
  if (tip.profile == nullptr)
  {
    throw Error(ErrorCode::BadValue, "profile of the tip: none; give the points of one");
  }
  checkRadius(tip.profile->baseRadius(), "base radius of the profile");
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

double flatRadius(const Tip& tip) noexcept
{
  if (const auto* punch = std::get_if<PunchTip>(&tip))
  {
    return punch->radius;
  }
  if (const auto* truncated = std::get_if<TruncatedConeTip>(&tip))
  {
    return truncated->flatRadius;
  }
  if (const auto* profile = std::get_if<ProfileTip>(&tip))
  {
    return profile->profile->flatRadius();
  }
  return 0.0;
}

double noseRadius(const Tip& tip) noexcept
{
  if (const auto* sphere = std::get_if<SphereTip>(&tip))
  {
    return sphere->radius;
  }
  if (const auto* blunt = std::get_if<BluntConeTip>(&tip))
  {
    return blunt->tipRadius;
  }
  if (const auto* paraboloid = std::get_if<ParaboloidTip>(&tip))
  {
    return paraboloid->radius;
  }
  if (const auto* profile = std::get_if<ProfileTip>(&tip))
  {
    return profile->profile->noseRadius();
  }
  return 0.0;
}

Tip checkedTip(Tip tip)
{
  std::visit([](const auto& shape) { check(shape); }, tip);
  return tip;
}

} // namespace palp
