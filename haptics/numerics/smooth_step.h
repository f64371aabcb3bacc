#pragma once

#include <algorithm>

namespace palp
{

/// From 0 at t = 0 to 1 at t = 1, level at both ends and constant beyond them.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] constexpr double smoothStep(double t) noexcept
{
  const double within = std::clamp(t, 0.0, 1.0);
  return within * within * (3.0 - 2.0 * within);
}

} // namespace palp
