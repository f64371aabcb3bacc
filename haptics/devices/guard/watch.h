#pragma once

#include "haptics/devices/guard/guard_block.h"

namespace palp
{

/// The guardian's whole life: zero force when the program dies, stops, hangs or was suspended.
///
/// Returns when the program has ended, its force with it.
/// @param device   shared with the program
/// @param program  a pidfd
/// @param link     pipe whose other end only the program has
/// @realtime       no allocation, no lock, no exception
void watch(GuardBlock& block, int device, int program, int link) noexcept;

} // namespace palp
