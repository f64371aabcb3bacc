#pragma once

#include "pipeline/color/lab.h"

namespace palp::color
{

/// A map of colors from that of a thing itself to a bright yellow: equal steps of the value are
/// equal steps to the eye, in lightness as in all of L*a*b*. So it is read in gray and by those who
/// see no red or green, too.
///
/// @param zero   color of the value 0; darker than the other end
/// @param share  of the largest value, 0 to 1
[[nodiscard]] Rgb evenMap(const Rgb& zero, double share) noexcept;

} // namespace palp::color
