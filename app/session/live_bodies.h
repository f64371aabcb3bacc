#pragma once

#include "app/input/scene_plan.h"
#include "app/press/body.h"

namespace palp
{

/// As loadBodies, to be drawn live: each body of so many triangles that they take long to draw
/// without a graphics card also has a coarse level of few.
/// @throws Error  as loadBodies
[[nodiscard]] SceneBody loadLiveBodies(const ScenePlan& plan);

} // namespace palp
