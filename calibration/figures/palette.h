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

inline constexpr int kShades = 8;

/// A color of values that rise, the darkest first; even in lightness.
/// @source  viridis, Smith and van der Walt 2015
[[nodiscard]] constexpr const char* shadeColor(int index) noexcept
{
  constexpr std::array<const char*, kShades> kRising{ "#440154", "#46327e", "#365c8d", "#277f8e",
    "#1fa187", "#4ac16d", "#a0da39", "#fde725" };
  return kRising[static_cast<std::size_t>(index) % kRising.size()];
}

/// Of the band that a hand does not notice; curves lie over it.
inline constexpr const char* kBandColor = "#b8bfc9";

} // namespace palp::figures
