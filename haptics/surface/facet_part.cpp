#include "haptics/surface/facet_part.h"

#include <Eigen/Geometry>
#include <cmath>

namespace palp
{

std::array<Eigen::Matrix3d, 3> bendsOf(
  const LinkedTriangles& mesh, const Facet& facet, int triangle)
{
  std::array<Eigen::Matrix3d, 3> result;
  for (std::size_t k = 0; k < 3; ++k)
  {
    result[k].setZero();
    const int other = mesh.across[static_cast<std::size_t>(triangle)][k];
    if (other < 0)
    {
      continue;
    }
    const Eigen::Vector3d beyond =
      unitNormal(mesh.points, mesh.triangles[static_cast<std::size_t>(other)]);
    const Eigen::Vector3d along = (facet.corners[(k + 1) % 3] - facet.corners[k]).normalized();
    const Eigen::Vector3d across = along.cross(facet.normal + beyond).normalized();
    const double turn = std::atan2(facet.normal.cross(beyond).dot(along), facet.normal.dot(beyond));
    result[k] = 0.5 * turn * across * across.transpose();
  }
  return result;
}

} // namespace palp
