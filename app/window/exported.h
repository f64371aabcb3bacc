#pragma once

#include "app/input/scene_plan.h"
#include "app/press/calibration.h"
#include "app/press/press_log.h"
#include "app/press/recording.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

namespace palp
{

/// What a file is made from, on a thread of its own.
struct Exported
{
  ScenePlan plan;
  Recording recording; ///< without samples and names of presses until take()
  Calibration calibration;
  std::vector<std::function<Recording()>> parts; ///< of it, one after the other
  PressNames names;

  /// Copies them, which takes longer than a window may wait. Once.
  void take()
  {
    recording.names.clear();
    for (const auto& copy : std::exchange(parts, {}))
    {
      Recording part = copy();
      std::ranges::move(names(part), std::back_inserter(recording.names));
      append(recording, std::move(part.samples));
    }
    plan.recording->names = recording.names;
  }
};

} // namespace palp
