#pragma once

#include "app/scene_plan.h"

#include <filesystem>

namespace palp
{

class Ledger;
struct Pictures;

/// Presses along the plan's path in simulated time and writes what the plan exports.
///
/// @param plan      its device is scripted
/// @param chained   the force goes through the safety chain of the paper's device, armed
/// @param pictures  null only where the plan draws nothing
/// @throws Error    as loadBody, readPath, loadCalibration, writeDeformed, Pictures
void playPlan(const ScenePlan& plan, bool chained, const std::filesystem::path& out,
  const Pictures* pictures, Ledger& ledger);

} // namespace palp
