#include "calibration/study/curve_fit.h"

#include <algorithm>

namespace palp::fem
{

ExtentFits fitExtent(const std::vector<double>& depths, const std::vector<double>& extents)
{
  constexpr double kHolds = 0.03;    // residual to the largest radius
  constexpr std::size_t kFewest = 4; // points through which a line says something
  std::vector<double> x;
  std::vector<double> y;
  ExtentFits fits;
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    if (extents[i] <= 0.0)
    {
      continue;
    }
    x.push_back(depths[i]);
    y.push_back(extents[i]);
    const PolynomialFit line = fitPolynomial(x, y, 1);
    if (x.size() >= kFewest && line.worst <= kHolds * *std::max_element(y.begin(), y.end()))
    {
      fits.linear = line;
      fits.linearHoldsTo = depths[i];
    }
  }
  fits.quadratic = fitPolynomial(x, y, 2);
  return fits;
}

} // namespace palp::fem
