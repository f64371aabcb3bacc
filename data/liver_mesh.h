#pragma once

#include "data/shapes.h"

namespace palp
{

/// Closed, even surface of the bundled liver, in the frame of liverDistance().
///
/// @param edge  wanted edge length, 1 to 4 mm [m]; 2 mm gives about 20,000 points
[[nodiscard]] Mesh makeLiver(double edge);

} // namespace palp
