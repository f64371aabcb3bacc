#include "haptics/numerics/statistics.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

// Abramowitz and Stegun 1964, Table 26.10, of both sides
TEST(StudentQuantile, IsThatOfThePrintedTable)
{
  EXPECT_NEAR(studentQuantile(0.95, 1.0), 12.706, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 2.0), 4.303, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 5.0), 2.571, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 30.0), 2.042, 5e-4);
  EXPECT_NEAR(studentQuantile(0.99, 10.0), 3.169, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 1e6), 1.960, 5e-4); // the normal distribution
}

} // namespace
} // namespace palp
