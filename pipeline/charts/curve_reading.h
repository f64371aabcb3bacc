#pragma once

#include <optional>
#include <span>
#include <string>

namespace palp
{

/// Where a line through points, in any order, passes a place of the horizontal axis.
///
/// @param x, y     of the points, as many of each
/// @param at       place on the axis
/// @param wanted   of several values the one nearest to this
/// @return         the value; none beside the line
[[nodiscard]] std::optional<double> valueOfLine(
  std::span<const double> x, std::span<const double> y, double at, double wanted);

/// A value with as many decimals as a step can be told by, as the pixel of a chart.
/// @param step  more than 0
[[nodiscard]] std::string readingText(double value, double step);

/// What stands in the brackets at the end of a title, as "N" of "force [N]"; empty without any.
[[nodiscard]] std::string unitOf(const std::string& title);

} // namespace palp
