#include "tests/pipeline/formats/fuzzed_surfaces.h"

#include "tests/pipeline/formats/fuzzed_parts.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iterator>

namespace palp::test
{

const std::vector<Fuzzed>& fuzzedSurfaces()
{
  static const std::vector<Fuzzed> all = []
  {
    std::vector<Fuzzed> every = fuzzedMeshes();
    std::ranges::move(fuzzedImages(), std::back_inserter(every));
    return every;
  }();
  return all;
}

void fuzzSurface(std::size_t which, int count)
{
  ASSERT_EQ(fuzzedSurfaces().size(), kFuzzedSurfaces);
  const Fuzzed& kind = fuzzedSurfaces()[which];
  const char* asked = std::getenv("PALP_FUZZ");
  constexpr std::size_t memory = 832U << 20; // of palp-read for a small file, and this program
  constexpr double time = 4.0;               // of palp-read for a small file [s]
  expectGoodFates(kind, fuzz(kind, asked ? std::atoi(asked) : count, memory, time));
}

std::string nameOf(const Fuzzed& kind)
{
  std::string name = kind.file;
  std::ranges::replace(name, '.', '_');
  return name;
}

} // namespace palp::test
