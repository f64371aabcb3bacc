#pragma once

#include <vector>

namespace palp
{

struct Quadrature
{
  std::vector<double> nodes;
  std::vector<double> weights;
};

/// Gauss and Legendre's rule on an interval: exact for polynomials of degree 2 count - 1.
///
/// @param count  1 to 200
[[nodiscard]] Quadrature gaussLegendre(int count, double from, double to);

} // namespace palp
