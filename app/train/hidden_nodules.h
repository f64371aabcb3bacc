#pragma once

#include "app/input/scene_plan.h"
#include "app/train/curriculum.h"
#include "haptics/force/force_law.h"
#include "haptics/force/nodules/nodule_field.h"
#include "haptics/surface/surface.h"

#include <vector>

namespace palp
{

/// Nodules of a level at places that follow from the seed, the body and the tool alone.
///
/// Each lies in the body as deep as the level says, where the law is within its limits and the
/// nodule within what was compared with finite elements; 15 mm at least from sharp edges, 5 mm from
/// the far side; no mark can find two; and right above it the level's press feels it by the level's
/// contrast, as palp detect computes it.
///
/// @param law     of the tool that searches, corrected
/// @throws Error  BadValue: another law; no room; as dartsFacing
[[nodiscard]] std::vector<PlacedNodule> hideNodules(const Surface& surface, const ForceLaw& law,
  const Curriculum& curriculum, const TrainingPlan& plan);

} // namespace palp
