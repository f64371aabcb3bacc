#pragma once

#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"

#include <vector>

namespace palp
{

/// Plays a path through the servo step in simulated time: one sample per millisecond, both ends
/// included, no arming, ramp or slew limit; or, armed from the start, through the safety chain that
/// the paper's device would have.
///
/// Where the path gives no axis the tool points along the inward surface normal at the nearest
/// surface point, at the apex's first touch, or at its closest approach when it never touches.
[[nodiscard]] std::vector<Sample> play(
  const ScriptedPath& path, const Scene& scene, bool chained = false);

} // namespace palp
