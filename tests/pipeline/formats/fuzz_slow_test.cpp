#include "tests/pipeline/formats/fuzzed_surfaces.h"

#include <gtest/gtest.h>

// nightly; the short form is fuzz_test

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
  fuzzSurface(GetParam(), 100'000);
}

} // namespace
} // namespace palp::test
