#include "tests/pipeline/formats/fuzzed_surfaces.h"

#include <gtest/gtest.h>

// some hundred damaged files of each kind; fuzz_slow_test takes many

namespace palp::test
{
namespace
{

class Fuzz : public testing::TestWithParam<std::size_t>
{
};
INSTANTIATE_TEST_SUITE_P(Kinds, Fuzz, testing::Range<std::size_t>(0, kFuzzedSurfaces),
  [](const auto& which) { return nameOf(fuzzedSurfaces()[which.param]); });

TEST_P(Fuzz, EndsAsASurfaceOrATrueSentence)
{
  fuzzSurface(GetParam(), 200);
}

} // namespace
} // namespace palp::test
