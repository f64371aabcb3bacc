#pragma once

#include "app/folder/export_folder.h"
#include "app/input/scene_plan.h"

#include <optional>

namespace palp
{

/// The whole of `palp view`.
struct ViewOptions
{
  ScenePlan plan;
  std::optional<ExportFolder> made{}; ///< of an export that is opened: what was pressed before
  bool explain = false; ///< tell what was built once the first picture stands, and end
};

} // namespace palp
