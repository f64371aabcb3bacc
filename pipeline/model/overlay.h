#pragma once

#include <array>
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
  IsoLines,       ///< of equal displacement
};

inline constexpr std::size_t kOverlayCount = 10;

/// Whether it is a color of the dent itself rather than something over it.
constexpr bool isColoring(Overlay overlay) noexcept
{
  return overlay == Overlay::DisplacementColors || overlay == Overlay::PressureColors ||
    overlay == Overlay::ValidityColors;
}

/// Those that are shown at first.
inline constexpr std::array kUsualOverlays{ Overlay::ForceArrow, Overlay::ContactCircle,
  Overlay::ExtentCircle, Overlay::DisplacementColors, Overlay::IsoLines, Overlay::Readings };

} // namespace palp
