#pragma once

#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"

namespace palp
{

/// Tool pose in, force out: contact, analytical law, damping, limit.
///
/// The tissue pushes and never pulls, however fast the tool withdraws. The caller sets the time.
///
/// @return    a sample whose force is finite and no longer than scene.forceLimit; zero, and
///            flagged, where the pose or what follows from it is not finite
/// @source    Fig. 9(b)
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Sample step(const Scene& scene, const ToolPose& pose) noexcept;

} // namespace palp
