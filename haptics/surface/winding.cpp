#include "haptics/surface/winding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palp
{
namespace
{

constexpr double kFar = 2.0; // [-] radii of a node

// of a triangle as a place sees it, positive from behind
double solidAngle(const Facet& facet, const Eigen::Vector3d& position) noexcept
{
  const Eigen::Vector3d a = facet.corners[0] - position;
  const Eigen::Vector3d b = facet.corners[1] - position;
  const Eigen::Vector3d c = facet.corners[2] - position;
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2.0 *
    std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

} // namespace

Winding::Winding(BoxTree tree)
  : tree_(std::move(tree))
  , dipoles_(tree_.nodes().size())
{
  for (std::size_t i = dipoles_.size(); i-- > 0;) // children stand behind their parents
  {
    const BoxTree::Node& node = tree_.nodes()[i];
    Dipole& dipole = dipoles_[i];
    const auto add = [&](const Eigen::Vector3d& center, const Eigen::Vector3d& area, double size)
    {
      dipole.center += size * center;
      dipole.area += area;
      dipole.size += size;
    };
    for (int k = node.first; k < node.first + node.count; ++k)
    {
      const auto& [a, b, c] = tree_.facets()[at(k)].corners;
      const Eigen::Vector3d area = 0.5 * (b - a).cross(c - a);
      add((a + b + c) / 3.0, area, area.norm());
    }
    if (node.count == 0)
    {
      for (const Dipole& child : { dipoles_[i + 1], dipoles_[at(node.first)] })
      {
        add(child.center, child.area, child.size);
      }
    }
    dipole.center /= dipole.size;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double x = dipole.center[static_cast<Eigen::Index>(k)];
      const double farthest =
        std::max(x - static_cast<double>(node.low[k]), static_cast<double>(node.high[k]) - x);
      dipole.squaredRadius += farthest * farthest;
    }
  }
}

double Winding::operator()(const Eigen::Vector3d& position) const noexcept
{
  double angle = 0.0;
  tree_.search(
    [&](const BoxTree::Node& node)
    {
      const auto index = static_cast<std::size_t>(&node - tree_.nodes().data());
      const Dipole& dipole = dipoles_[index];
      const Eigen::Vector3d away = dipole.center - position;
      const double squared = away.squaredNorm();
      const bool isNear = squared < kFar * kFar * dipole.squaredRadius;
      angle += isNear ? 0.0 : dipole.area.dot(away) / (squared * std::sqrt(squared));
      return isNear;
    },
    [&](int facet) { angle += solidAngle(tree_.facets()[at(facet)], position); });
  return 0.25 * std::numbers::inv_pi * angle;
}

} // namespace palp
