#include "data/implicit.h"

#include <cmath>

namespace palp
{
namespace
{

Eigen::Vector3d gradient(const Distance& distance, const Eigen::Vector3d& p)
{
  constexpr double step = 1e-5; // [m], far below every radius of curvature
  Eigen::Vector3d slope;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d ahead = p + step * Eigen::Vector3d::Unit(i);
    const Eigen::Vector3d behind = p - step * Eigen::Vector3d::Unit(i);
    slope[i] = (distance(ahead) - distance(behind)) / (2.0 * step);
  }
  return slope;
}

} // namespace

Eigen::Vector3d levelNormal(const Distance& distance, const Eigen::Vector3d& p)
{
  return gradient(distance, p).normalized();
}

Eigen::Vector3d ontoSurface(const Distance& distance, Eigen::Vector3d p)
{
  for (int i = 0; i < 20; ++i)
  {
    const double d = distance(p);
    if (std::abs(d) < 1e-10)
    {
      break;
    }
    const Eigen::Vector3d slope = gradient(distance, p);
    p -= d * slope / slope.squaredNorm();
  }
  return p;
}

} // namespace palp
