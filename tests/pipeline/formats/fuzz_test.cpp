#include "tests/pipeline/formats/fuzzed_parts.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>

namespace palp::test
{
namespace
{

// all are taken as the program does: the answer of palp-read unpacked, repaired, made a Surface
// with its box tree, and pressed
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

constexpr std::size_t kFuzzedSurfaces = 20;

class Fuzz : public testing::TestWithParam<std::size_t>
{
};
INSTANTIATE_TEST_SUITE_P(Kinds, Fuzz, testing::Range<std::size_t>(0, kFuzzedSurfaces),
  [](const auto& which) { return nameOf(fuzzedSurfaces()[which.param]); });

TEST_P(Fuzz, EndsAsASurfaceOrATrueSentence)
{
  ASSERT_EQ(fuzzedSurfaces().size(), kFuzzedSurfaces);
  const Fuzzed& kind = fuzzedSurfaces()[GetParam()];
  constexpr std::size_t memory = 832U << 20; // of palp-read for a small file, and this program
  constexpr double time = 4.0;               // of palp-read for a small file [s]
#ifdef PALP_SLOW
  const int count = fuzzCount();
#else // without the sanitizer the same again, for the limits of time and memory
  const int count = fuzzCount(kSanitized ? 10'000 : 400);
#endif
  expectGoodFates(kind, fuzz(kind, count, memory, time));
}

} // namespace
} // namespace palp::test
