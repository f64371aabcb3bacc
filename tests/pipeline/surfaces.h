#pragma once

#include "pipeline/dent.h"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace palp::test
{

/// A triangle surface in plain arrays, with a dent.
struct DentedSurface
{
  std::vector<float> rest;
  std::vector<Triangle> triangles;
  std::vector<float> points, normals, displacement;
  std::vector<unsigned char> zone;
  Dent dent;

  [[nodiscard]] std::size_t count() const
  {
    return rest.size() / 3;
  }

  [[nodiscard]] DentArrays arrays()
  {
    return { points.data(), normals.data(), displacement.data(), zone.data() };
  }

  static Eigen::Vector3d at(const std::vector<float>& values, std::size_t i)
  {
    return { values[3 * i], values[3 * i + 1], values[3 * i + 2] };
  }

  void add(const Eigen::Vector3d& point)
  {
    for (const double x : point)
    {
      rest.push_back(static_cast<float>(x));
    }
  }

  void finish()
  {
    points.resize(rest.size());
    normals.resize(rest.size());
    displacement.resize(rest.size());
    zone.resize(count());
    dent = Dent(rest, triangles);
    dent.reset(arrays());
  }

  void press(const Press& with)
  {
    dent.update(with, arrays());
  }
};

/// A square plane z = 0 of n x n cells of a width, seen from above.
inline DentedSurface plane(int n, double width)
{
  DentedSurface surface;
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      surface.add({ (i - 0.5 * n) * width, (j - 0.5 * n) * width, 0.0 });
    }
  }
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const int a = j * (n + 1) + i;
      surface.triangles.push_back({ a, a + 1, a + n + 2 });
      surface.triangles.push_back({ a, a + n + 2, a + n + 1 });
    }
  }
  surface.finish();
  return surface;
}

/// An ellipsoid of given half axes, of 8 x 4^level triangles.
inline DentedSurface ellipsoid(int level, const Eigen::Vector3d& axes)
{
  std::vector<Eigen::Vector3d> points{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 },
    { 0, -1, 0 }, { 0, 0, -1 } };
  std::vector<Triangle> triangles{ { 0, 1, 2 }, { 1, 3, 2 }, { 3, 4, 2 }, { 4, 0, 2 }, { 1, 0, 5 },
    { 3, 1, 5 }, { 4, 3, 5 }, { 0, 4, 5 } };
  for (int k = 0; k < level; ++k)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b)
    {
      const auto [it, isNew] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (isNew)
      {
        points.push_back(
          (points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)]).normalized());
      }
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles)
    {
      const int ab = middle(a, b);
      const int bc = middle(b, c);
      const int ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
    }
    triangles = std::move(finer);
  }
  DentedSurface surface;
  for (const Eigen::Vector3d& point : points)
  {
    surface.add(point.cwiseProduct(axes));
  }
  surface.triangles = std::move(triangles);
  surface.finish();
  return surface;
}

/// A tool pressed along a normal at a point of the surface, its axis turned by an angle.
inline Press pressAt(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Tip& tip,
  double depth, double extentRadius)
{
  Press press;
  press.tip = tip;
  press.contact = { .depth = depth, .normal = normal, .center = point };
  press.pose = { .apex = point - depth * normal, .axis = -normal };
  const auto* sphere = std::get_if<SphereTip>(&tip);
  const auto* cone = std::get_if<ConeTip>(&tip);
  press.contactRadius = sphere ? std::sqrt(sphere->radius * depth)
    : cone                     ? 2.0 / 3.14159265358979323846 * depth * std::tan(cone->halfAngle)
                               : baseRadius(tip);
  press.contactRadius = std::min(press.contactRadius, baseRadius(tip));
  press.extentRadius = extentRadius;
  return press;
}

} // namespace palp::test
