#pragma once

#include "calibration/organ/organ_model.h"
#include "haptics/surface/surface.h"

#include <string>

namespace palp
{

/// Where a body rests, as text: `KIND:box:X0,Y0,Z0:X1,Y1,Z1` in mm holds it within a box, and
/// `KIND:direction:X,Y,Z:ANGLE` where its surface faces a direction within an angle. KIND is
/// `bonded`, or `sliding`, which holds it across the mean of that surface only.
///
/// @param surface  closed; it has to live as long as the result
/// @throws Error   BadValue: names what is wrong, or that it holds nothing of the surface
[[nodiscard]] Support parseSupport(const std::string& text, const Surface& surface);

} // namespace palp
