#pragma once

#include <cstddef>

namespace palp
{

/// What is drawn over the surface; each can be hidden, and then costs nothing.
enum class Overlay
{
  ForceArrow,
  ContactCircle,
  ExtentCircle,
  DisplacementColors,
  Readings,
  PressureColors, ///< instead of the displacement
  ValidityColors, ///< instead of both: green, amber, red
  ControlNet,     ///< of the Bezier patches
  Ghost,          ///< the undeformed surface
};

inline constexpr std::size_t kOverlayCount = 9;

} // namespace palp
