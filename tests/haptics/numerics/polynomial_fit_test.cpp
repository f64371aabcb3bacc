#include "haptics/numerics/polynomial_fit.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

// a fit finds the polynomial that the points were taken from
TEST(PolynomialFit, RecoversAParabola)
{
  const std::vector<double> x{ 1, 2, 3, 4, 5 };
  std::vector<double> y;
  for (const double value : x)
  {
    y.push_back(2.0 - 0.5 * value + 0.25 * value * value);
  }
  const PolynomialFit fit = fitPolynomial(x, y, 2);
  EXPECT_NEAR(fit.coefficients[0], 2.0, 1e-12);
  EXPECT_NEAR(fit.coefficients[1], -0.5, 1e-12);
  EXPECT_NEAR(fit.coefficients[2], 0.25, 1e-12);
  EXPECT_LT(fit.worst, 1e-12);
  EXPECT_NEAR(fit(10.0), 22.0, 1e-11);
  EXPECT_EQ(fit.upTo, 5.0);
}

// residuals of 0, 1, 1, 0 at 0, 1, 2, 3 from their mean, by hand: the slope is nothing
TEST(PolynomialFit, StatesItsResiduals)
{
  const std::vector<double> x{ 0, 1, 2, 3 };
  const std::vector<double> y{ 0, 1, 1, 0 };
  const PolynomialFit fit = fitPolynomial(x, y, 1);
  EXPECT_NEAR(fit.coefficients[0], 0.5, 1e-12);
  EXPECT_NEAR(fit.coefficients[1], 0.0, 1e-12);
  EXPECT_NEAR(fit.rms, 0.5, 1e-12);
  EXPECT_NEAR(fit.worst, 0.5, 1e-12);
}

TEST(PolynomialFit, OfTooFewPointsIsEmpty)
{
  const PolynomialFit fit = fitPolynomial(std::vector{ 1.0 }, std::vector{ 1.0 }, 1);
  EXPECT_TRUE(fit.coefficients.empty());
  EXPECT_EQ(fit(1.0), 0.0);
}

} // namespace
} // namespace palp
