#include "haptics/numerics/quadrature.h"

#include <cmath>
#include <numbers>

namespace palp
{

Quadrature gaussLegendre(int count, double from, double to)
{
  Quadrature rule;
  for (int i = count; i > 0; --i)
  {
    // Newton's method on the Legendre polynomial, from Tricomi's estimate of its root
    double x = std::cos(std::numbers::pi * (i - 0.25) / (count + 0.5));
    double derivative = 1.0;
    for (int step = 0; step < 8; ++step)
    {
      double previous = 1.0;
      double value = x;
      for (int n = 2; n <= count; ++n)
      {
        const double next = ((2 * n - 1) * x * value - (n - 1) * previous) / n;
        previous = value;
        value = next;
      }
      derivative = count * (x * value - previous) / (x * x - 1.0);
      x -= value / derivative;
    }
    rule.nodes.push_back(from + 0.5 * (to - from) * (1.0 + x));
    rule.weights.push_back((to - from) / ((1.0 - x * x) * derivative * derivative));
  }
  return rule;
}

} // namespace palp
