#pragma once

#include "app/input/scene_plan.h"
#include "app/press/calibration.h"
#include "app/press/recording.h"

#include <optional>

namespace palp
{

struct SceneBody;

/// A recording with all that it was made on, which outlive this.
struct Pictured
{
  const SceneBody& body;
  const Recording& recording;
  const Calibration& calibration;
  std::optional<CameraPlace> seenFrom{}; ///< as its body was left for another; none: it is open
};

} // namespace palp
