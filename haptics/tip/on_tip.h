#pragma once

#include "haptics/tip/tip.h"

#include <cmath>

namespace palp
{

/// Slope of a cone's flank.
/// @param angle  alpha [rad] between axis and flank
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] inline double cot(double angle) noexcept
{
  return 1.0 / std::tan(angle);
}

/// Calls function with the shape that a tip has.
///
/// By get_if for each shape in turn, because visit may throw and the servo thread may not.
///
/// @return    what function returns; for a variant that lost its value, a default
/// @realtime  as function
template <typename Function>
auto onTip(const Tip& tip, Function function) noexcept -> decltype(function(SphereTip{}))
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
  if (const auto* profile = std::get_if<ProfileTip>(&tip))
  {
    return function(*profile);
  }
  return {};
}

} // namespace palp
