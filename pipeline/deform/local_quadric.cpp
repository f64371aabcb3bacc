#include "pipeline/deform/local_quadric.h"

#include <Eigen/Dense>
#include <array>

namespace palp
{

void LocalQuadric::fit(const PressRegion& region, double reach)
{
  const double scale = 1.0 / reach;
  reach_ = reach;
  Eigen::Matrix<double, 6, 6> sums;
  Coefficients heights = Coefficients::Zero();
  // the sums of w x^i y^j, of which the normal equations have each several times
  std::array<double, 15> moments{};
  for (const GeodesicCoordinates& geodesic : region.geodesics())
  {
    const double x = scale * geodesic.local.x();
    const double y = scale * geodesic.local.y();
    const double left = 1.0 - x * x - y * y;
    if (!(left > 0.0) || !geodesic.isFront())
    {
      continue;
    }
    const double weight = left * left * (1.0 - static_cast<double>(geodesic.steepness));
    const double xx = x * x;
    const double xy = x * y;
    const double yy = y * y;
    const std::array<double, 15> terms{ 1.0, x, y, xx, xy, yy, xx * x, xx * y, yy * x, yy * y,
      xx * xx, xx * xy, xx * yy, xy * yy, yy * yy };
    for (std::size_t i = 0; i < moments.size(); ++i)
    {
      moments[i] += weight * terms[i];
    }
    for (std::size_t i = 0; i < 6; ++i)
    {
      heights[static_cast<Eigen::Index>(i)] += weight * geodesic.local.z() * terms[i];
    }
  }
  const auto& m = moments;
  sums << m[0], m[1], m[2], m[3], m[4], m[5], //
    m[1], m[3], m[4], m[6], m[7], m[8],       //
    m[2], m[4], m[5], m[7], m[8], m[9],       //
    m[3], m[6], m[7], m[10], m[11], m[12],    //
    m[4], m[7], m[8], m[11], m[12], m[13],    //
    m[5], m[8], m[9], m[12], m[13], m[14];
  // a trace of stiffness keeps at zero what few points leave open
  sums.diagonal().array() += 1e-6 * sums(0, 0) + 1e-12;
  Coefficients units;
  units << 1.0, scale, scale, scale * scale, scale * scale, scale * scale;
  coefficients_ = sums.ldlt().solve(heights).cwiseProduct(units);
}

} // namespace palp
