#pragma once

#include "tests/support/damage.h"
#include "tests/support/fates.h"

#include <cstddef>

namespace palp::test
{

/// Reads damaged files, many in one forked process, which is replaced after a crash; a file that
/// ends it is tried again, its reading and its taking each in a process of its own.
///
/// @param count   how many; the same ones each time
/// @param memory  [bytes] that a reading of this size may take
/// @param time    [s] of processor time that it may take
[[nodiscard]] Fates fuzz(const Fuzzed& kind, int count, std::size_t memory, double time);

} // namespace palp::test
