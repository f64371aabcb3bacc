#pragma once

#include "calibration/organ/organ_model.h"
#include "calibration/tables/organ_table.h"
#include "haptics/surface/surface.h"

#include <stop_token>

namespace palp
{

/// Adds to a table that knows all of its places how the whole surface moves under a load at each
/// of at most 600 of them, in at most 24 modes: singular vectors of these motions, each taken over
/// its length, so that stiff places count as much as soft ones.
///
/// @return        whether it was done; else it was stopped
/// @throws Error  as OrganModel::solve
[[nodiscard]] bool addMotion(
  OrganTable& table, const OrganModel& model, const Surface& surface, const std::stop_token& stop);

} // namespace palp
