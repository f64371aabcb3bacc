#pragma once

#include <array>

namespace palp::color
{

using Rgb = std::array<double, 3>; ///< red, green, blue of sRGB, 0 to 1

/// A color by what an eye sees of it.
struct Lab
{
  double lightness; ///< L*, 0 to 100
  double a;         ///< from green to red
  double b;         ///< from blue to yellow
};

/// @source IEC 61966-2-1:1999 for sRGB, CIE 15:2004 for L*a*b*, under D65
[[nodiscard]] Lab labOf(const Rgb& rgb) noexcept;

/// The inverse; a color that a screen has not becomes one near it.
[[nodiscard]] Rgb rgbOf(const Lab& lab) noexcept;

} // namespace palp::color
