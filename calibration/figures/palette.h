#pragma once

#include <array>
#include <cstddef>

namespace palp::figures
{

/// A color that figures and legends of a page share, as #rrggbb; apart for every kind of color
/// vision.
/// @source  Okabe and Ito 2008
[[nodiscard]] constexpr const char* paletteColor(int index) noexcept
{
  constexpr std::array kPalette{ "#1a1c21", "#0072b2", "#d55e00", "#009e73", "#56b4e9", "#cc79a7",
    "#e69f00", "#7f7f7f" };
  return kPalette[static_cast<std::size_t>(index) % kPalette.size()];
}

/// Of the band that a hand does not notice; curves lie over it.
inline constexpr const char* kBandColor = "#b8bfc9";

} // namespace palp::figures
