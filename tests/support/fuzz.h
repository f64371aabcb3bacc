#pragma once

#include "tests/support/damage.h"
#include "tests/support/fates.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string>

namespace palp::test
{

/// Reads damaged files, many in one forked process, which is replaced after a crash; a file that
/// ends it is tried again, its reading and its taking each in a process of its own.
///
/// @param count   how many; the same ones each time; fewer where PALP_FUZZ_MINUTES are over
/// @param memory  [bytes] that a reading of this size may take
/// @param time    [s] of processor time that it may take
[[nodiscard]] Fates fuzz(const Fuzzed& kind, int count, std::size_t memory, double time);

/// Files of each kind for a test: some, many with PALP_SLOW, the number in PALP_FUZZ, or as many as
/// come in PALP_FUZZ_MINUTES.
inline int fuzzCount(int some = 10'000)
{
  if (std::getenv("PALP_FUZZ_MINUTES") != nullptr)
  {
    return std::numeric_limits<int>::max();
  }
#if defined(PALP_SLOW)
  const int usual = std::max(some, 100'000);
#else
  const int usual = some;
#endif
  const char* asked = std::getenv("PALP_FUZZ");
  return asked ? std::atoi(asked) : usual;
}

/// A kind's file, as the name of a test.
[[nodiscard]] inline std::string nameOf(std::string file)
{
  std::ranges::replace(file, '.', '_');
  return file;
}

} // namespace palp::test
