#include "tests/pipeline/deform/dent_range.h"

namespace palp
{
namespace
{

using namespace test;

// every tool, body, law and picture
class DentRange : public ::testing::TestWithParam<RangeCase>
{
};
INSTANTIATE_TEST_SUITE_P(Dent, DentRange,
  ::testing::ValuesIn(
    rangeCases({ "block", "ball", "liver", "coarse" }, { "paper", "exact", "corrected" })),
  [](const auto& with) { return nameOf(with.param); });

TEST_P(DentRange, PressingDeeper)
{
  pressDeeper(GetParam(), 0.01);
}

TEST_P(DentRange, Sliding)
{
  slide(GetParam(), 200);
}

} // namespace
} // namespace palp
