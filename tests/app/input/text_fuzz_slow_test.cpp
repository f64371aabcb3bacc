#include "tests/app/input/fuzzed_texts.h"

#include <gtest/gtest.h>

// nightly; the short form is text_fuzz_test

namespace palp::test
{
namespace
{

class Fuzz : public testing::TestWithParam<std::size_t>
{
};
INSTANTIATE_TEST_SUITE_P(Texts, Fuzz, testing::Range<std::size_t>(0, kFuzzedTexts),
  [](const auto& which) { return fuzzedTextName(which.param); });

TEST_P(Fuzz, EndsAsNumbersOrATrueSentence)
{
  fuzzText(GetParam(), 100'000);
}

} // namespace
} // namespace palp::test
