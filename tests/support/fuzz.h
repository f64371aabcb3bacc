#pragma once

#include "tests/support/damage.h"
#include "tests/support/fates.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string>

namespace palp::test
{

/// Reads damaged files, many in one forked process, which is replaced after a crash; a file that
/// ends it is tried again, its reading and its taking each in a process of its own.
///
/// @param count   how many; the same ones each time
/// @param memory  [bytes] that a reading of this size may take
/// @param time    [s] of processor time that it may take
[[nodiscard]] Fates fuzz(const Fuzzed& kind, int count, std::size_t memory, double time);

/// Files of each kind for a test: few, many with PALP_SLOW, or the number in PALP_FUZZ.
inline int fuzzCount()
{
#if defined(PALP_SLOW)
  constexpr int usual = 100'000;
#elif defined(__SANITIZE_ADDRESS__) // some five times slower
  constexpr int usual = 2'000;
#else
  constexpr int usual = 10'000;
#endif
  const char* asked = std::getenv("PALP_FUZZ");
  return asked ? std::atoi(asked) : usual;
}

/// A kind's file, as the name of a test.
[[nodiscard]] inline std::string nameOf(const Fuzzed& kind)
{
  std::string name = kind.file;
  std::ranges::replace(name, '.', '_');
  return name;
}

} // namespace palp::test
