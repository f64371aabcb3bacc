#include "tests/app/input/fuzzed_texts.h"

#include <gtest/gtest.h>

// some hundred damaged files of each kind; text_fuzz_slow_test takes many

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
  fuzzText(GetParam(), 200);
}

} // namespace
} // namespace palp::test
