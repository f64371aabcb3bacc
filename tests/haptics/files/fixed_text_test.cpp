#include "haptics/files/fixed_text.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(FixedText, RoundsToItsDigitsAndHasNoSignOfZero)
{
  EXPECT_EQ(fixed(12.345, 1), "12.3");
  EXPECT_EQ(fixed(-12.375, 2), "-12.38");
  EXPECT_EQ(fixed(2.5e300, 0).size(), 301U);
  EXPECT_EQ(fixed(-0.04, 1), "0.0");
  EXPECT_EQ(fixed(-0.06, 1), "-0.1");
  EXPECT_EQ(fixed(-0.0, 0), "0");
}

} // namespace
} // namespace palp
