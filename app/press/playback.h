#pragma once

#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"

#include <functional>
#include <span>
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

/// Whether rows lie closer than the samples, so that a touch between two of these is missed.
[[nodiscard]] bool isFinerThanSamples(const ScriptedPath& path);

/// Plays one path after the other, each as play() does, with 0.1 s between them in which the tool
/// is taken to the next one's start.
/// @param played  is given the samples of each, in the order of the paths
[[nodiscard]] std::vector<Sample> playEach(const std::vector<ScriptedPath>& paths,
  const Scene& scene, bool chained = false,
  const std::function<void(std::span<const Sample>)>& played = nullptr);

} // namespace palp
