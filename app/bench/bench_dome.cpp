#include "app/bench/bench_dome.h"

#include <cmath>
#include <numbers>

namespace palp
{

Mesh BenchDome::mesh() const
{
  Mesh mesh = makeGrid(n, size);
  for (Eigen::Vector3d& point : mesh.points)
  {
    point.z() = -0.5 * point.head<2>().squaredNorm() / size;
  }
  return mesh;
}

double BenchDome::radiusOf(double touched) const
{
  return size / n * std::sqrt(touched / std::numbers::pi);
}

Press BenchDome::press(double outer, double x) const
{
  const double radius = outer / 1.84;
  const double depth = 0.5 * radius;
  const Eigen::Vector3d normal = Eigen::Vector3d(x / size, 0.0, 1.0).normalized();
  Press press;
  press.tip = SphereTip{ radius };
  press.contact = { .depth = depth, .normal = normal, .center = { x, 0.0, -0.5 * x * x / size } };
  press.pose = { .apex = press.contact.center - depth * normal, .axis = -normal };
  press.contactRadius = std::sqrt(radius * depth);
  press.extentRadius = outer;
  return press;
}

} // namespace palp
