#include "tests/pipeline/deform/dent_range.h"

namespace palp
{
namespace
{

using namespace test;

// a part of what dent_range_slow_test tries
class DentRange : public ::testing::TestWithParam<RangeCase>
{
};
INSTANTIATE_TEST_SUITE_P(Dent, DentRange,
  ::testing::ValuesIn(rangeCases({ "block", "ball" }, { "paper" })),
  [](const auto& with) { return nameOf(with.param); });

TEST_P(DentRange, PressingDeeper)
{
  pressDeeper(GetParam(), 0.03);
}

TEST_P(DentRange, Sliding)
{
  slide(GetParam(), 10);
}

} // namespace
} // namespace palp
