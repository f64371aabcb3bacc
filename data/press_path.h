#pragma once

#include "haptics/devices/simulated/scripted_path.h"

#include <vector>

namespace palp
{

/// Motion of a spherical tool of 10 mm radius that presses the bundled liver, 4 s long.
///
/// Onto the convex front of the right lobe along its normal, 8 mm deep, then held, slid 12 mm
/// towards the midline at the same depth, held, and lifted; it starts and ends 5 mm above.
[[nodiscard]] std::vector<PathKnot> liverPressPath();

} // namespace palp
