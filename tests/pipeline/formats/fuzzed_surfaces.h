#pragma once

#include "tests/support/fuzz.h"

#include <string>
#include <vector>

namespace palp::test
{

/// Every kind of surface and image that palp-read reads, taken as the program does: its answer
/// unpacked, repaired, made a Surface with its box tree, and pressed.
[[nodiscard]] const std::vector<Fuzzed>& fuzzedSurfaces();

constexpr std::size_t kFuzzedSurfaces = 15;

/// One of them, with the limits of palp-read; PALP_FUZZ sets another count.
void fuzzSurface(std::size_t which, int count);

/// Its file, as the name of a test.
[[nodiscard]] std::string nameOf(const Fuzzed& kind);

} // namespace palp::test
