#pragma once

#include "app/input/scene_plan.h"
#include "app/press/calibration.h"
#include "app/press/recording.h"

namespace palp
{

/// What a file is made from, on a thread of its own.
struct Exported
{
  ScenePlan plan;
  Recording recording;
  Calibration calibration;
};

} // namespace palp
