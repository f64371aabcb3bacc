#include "haptics/surface/facet_part.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

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

std::vector<float> hollowRadii(const LinkedTriangles& mesh)
{
  std::vector<float> radii(mesh.triangles.size());
  std::vector<bool> met(radii.size());
  for (std::size_t start = 0; start < radii.size(); ++start)
  {
    if (met[start])
    {
      continue;
    }
    met[start] = true;
    std::vector<std::size_t> piece{ start };
    const Eigen::Vector3d& from = mesh.points[at(mesh.triangles[start][0])];
    double volume = 0.0; // six times that [m^3]
    double area = 0.0;   // twice that [m^2]
    bool isClosed = true;
    for (std::size_t next = 0; next < piece.size(); ++next)
    {
      const auto [a, b, c] = mesh.triangles[piece[next]];
      const Eigen::Vector3d u = mesh.points[at(a)] - from;
      const Eigen::Vector3d v = mesh.points[at(b)] - from;
      const Eigen::Vector3d w = mesh.points[at(c)] - from;
      volume += u.dot(v.cross(w));
      area += (v - u).cross(w - u).norm();
      for (const int other : mesh.across[piece[next]])
      {
        isClosed = isClosed && other >= 0;
        if (other >= 0 && !met[at(other)])
        {
          met[at(other)] = true;
          piece.push_back(at(other));
        }
      }
    }
    for (const std::size_t triangle : piece)
    {
      radii[triangle] = isClosed && volume < 0.0
        ? static_cast<float>(std::sqrt(area / (8.0 * std::numbers::pi)))
        : 0.0F;
    }
  }
  return radii;
}

} // namespace palp
