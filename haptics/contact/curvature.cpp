#include "haptics/contact/curvature.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace palp
{
namespace
{

constexpr int kAverages = 2;

// two unit vectors across a normal
Eigen::Matrix<double, 3, 2> tangents(const Eigen::Vector3d& normal) noexcept
{
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = normal.unitOrthogonal();
  basis.col(1) = normal.cross(basis.col(0));
  return basis;
}

// least squares of k(d) = a dx^2 + 2 b dx dy + c dy^2 over the edges from one point
Eigen::Matrix3f fit(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& point,
  const Eigen::Vector3d& normal, std::span<const int> neighbours)
{
  const Eigen::Matrix<double, 3, 2> basis = tangents(normal);
  Eigen::Matrix3d squares = 1e-6 * Eigen::Matrix3d::Identity(); // few edges leave some unknown
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const int neighbour : neighbours)
  {
    const Eigen::Vector3d edge = points[static_cast<std::size_t>(neighbour)] - point;
    const Eigen::Vector2d direction = (basis.transpose() * edge).normalized();
    if (edge.squaredNorm() == 0.0 || !direction.allFinite())
    {
      continue;
    }
    // of the circle through both ends with this normal at the first
    const double curvature = -2.0 * normal.dot(edge) / edge.squaredNorm();
    const Eigen::Vector3d row(direction.x() * direction.x(), 2.0 * direction.x() * direction.y(),
      direction.y() * direction.y());
    squares += row * row.transpose();
    right += curvature * row;
  }
  const Eigen::Vector3d abc = squares.ldlt().solve(right);
  Eigen::Matrix2d tensor;
  tensor << abc[0], abc[1], abc[1], abc[2];
  // with the mean along the normal as well, neighbours on a sphere have the same tensor
  const Eigen::Matrix3d inSpace =
    basis * tensor * basis.transpose() + 0.5 * tensor.trace() * normal * normal.transpose();
  return inSpace.allFinite() ? Eigen::Matrix3f(inSpace.cast<float>()) : Eigen::Matrix3f::Zero();
}

} // namespace

std::vector<Eigen::Matrix3f> curvatureTensors(std::span<const Eigen::Vector3d> points,
  std::span<const Eigen::Vector3d> normals,
  const std::function<std::span<const int>(int)>& neighbours)
{
  std::vector<Eigen::Matrix3f> tensors(points.size(), Eigen::Matrix3f::Zero());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (normals[i].squaredNorm() > 0.0)
    {
      tensors[i] = fit(points, points[i], normals[i], neighbours(static_cast<int>(i)));
    }
  }
  std::vector<Eigen::Matrix3f> averaged(tensors.size());
  for (int round = 0; round < kAverages; ++round)
  {
    for (std::size_t i = 0; i < tensors.size(); ++i)
    {
      const std::span<const int> around = neighbours(static_cast<int>(i));
      averaged[i] = tensors[i];
      for (const int neighbour : around)
      {
        averaged[i] += tensors[static_cast<std::size_t>(neighbour)];
      }
      averaged[i] /= static_cast<float>(around.size() + 1);
    }
    tensors.swap(averaged);
  }
  return tensors;
}

Curvature curvatureAcross(const Eigen::Matrix3d& tensor, const Eigen::Vector3d& normal) noexcept
{
  const Eigen::Matrix<double, 3, 2> basis = tangents(normal);
  const Eigen::Matrix2d plane = basis.transpose() * tensor * basis;
  return { .mean = 0.5 * plane.trace(),
    .spread = std::hypot(0.5 * (plane(0, 0) - plane(1, 1)), plane(0, 1)) };
}

} // namespace palp
