#include "haptics/numerics/quadrature.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

double integral(const Quadrature& rule, double (*function)(double))
{
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
  {
    sum += rule.weights[i] * function(rule.nodes[i]);
  }
  return sum;
}

TEST(GaussLegendre, HasTheTabulatedNodesOfThreePoints)
{
  const Quadrature rule = gaussLegendre(3, -1.0, 1.0);
  EXPECT_NEAR(rule.nodes[0], -std::sqrt(0.6), 1e-15);
  EXPECT_NEAR(rule.nodes[1], 0.0, 1e-15);
  EXPECT_NEAR(rule.weights[0], 5.0 / 9.0, 1e-15);
  EXPECT_NEAR(rule.weights[1], 8.0 / 9.0, 1e-15);
}

TEST(GaussLegendre, IsExactToTwiceItsDegree)
{
  for (int count = 1; count <= 100; count += 9)
  {
    const Quadrature rule = gaussLegendre(count, 0.0, 2.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    {
      sum += rule.weights[i] * std::pow(rule.nodes[i] / 2.0, 2 * count - 1);
    }
    EXPECT_NEAR(sum, 1.0 / count, 1e-13) << count;
  }
}

TEST(GaussLegendre, IntegratesAWaveTrain)
{
  const Quadrature rule = gaussLegendre(80, 0.0, 20.0);
  EXPECT_NEAR(
    integral(rule, [](double x) { return std::cos(3.0 * x); }), std::sin(60.0) / 3.0, 1e-12);
}

} // namespace
} // namespace palp
