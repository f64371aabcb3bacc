#pragma once

#include "haptics/devices/guard/guard_block.h"

namespace palp
{

/// Holds up each suspend of the machine until the motors hold no force: raises block.leaving when
/// logind announces one, and lets it come once the program has sent zero, or after 0.2 s.
///
/// Returns where there is no logind, or when its bus goes away: what is left then is the clock of
/// suspends. In a thread of its own, which may wait.
/// @source  org.freedesktop.login1, Inhibit and PrepareForSleep
void followSleep(GuardBlock& block) noexcept;

} // namespace palp
