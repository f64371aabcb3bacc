#include "tests/pipeline/formats/fuzzed_surfaces.h"

#include <gtest/gtest.h>

namespace palp::test
{
namespace
{

#ifdef PALP_SLOW
constexpr int kFiles = 100'000; // damaged ones of each kind
#else
constexpr int kFiles = 200;
#endif

class Fuzz : public testing::TestWithParam<std::size_t>
{
};
INSTANTIATE_TEST_SUITE_P(Kinds, Fuzz, testing::Range<std::size_t>(0, kFuzzedSurfaces),
  [](const auto& which) { return nameOf(fuzzedSurfaces()[which.param]); });

TEST_P(Fuzz, EndsAsASurfaceOrATrueSentence)
{
  fuzzSurface(GetParam(), kFiles);
}

} // namespace
} // namespace palp::test
