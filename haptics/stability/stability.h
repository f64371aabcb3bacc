#pragma once

#include "haptics/stability/stability_case.h"

#include <vector>

namespace palp
{

/// The cases: soft to rigid, compressible to nearly not, first touch to deeper than the tool,
/// sharp cone and flat punch, fast and slow loops, jitter and lost ticks, another tissue or surface
/// in contact, other devices, delays, hands that tap and hands that lean; then arms as they exist,
/// see arm_grid.h and tissue_grid.h.
///
/// @param quick  some of them: seconds, not minutes
[[nodiscard]] std::vector<StabilityCase> stabilityCases(bool quick);

/// Plays a case twice, with an exact and with a coarse encoder, through the chain or without.
[[nodiscard]] StabilityRow judge(const StabilityCase& which, bool chain);

} // namespace palp
