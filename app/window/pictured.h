#pragma once

#include "app/press/calibration.h"
#include "app/press/recording.h"

namespace palp
{

struct SceneBody;

/// A recording with all that it was made on, which outlive this.
struct Pictured
{
  const SceneBody& body;
  const Recording& recording;
  const Calibration& calibration;
};

} // namespace palp
