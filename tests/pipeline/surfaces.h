#pragma once

#include "data/shapes.h"
#include "pipeline/deform/dent.h"

#include <Eigen/Core>
#include <cmath>
#include <variant>
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

inline DentedSurface dented(const Mesh& mesh)
{
  DentedSurface surface;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    surface.add(point);
  }
  surface.triangles = mesh.triangles;
  surface.finish();
  return surface;
}

/// A square plane z = 0 of n x n cells of a width, seen from above.
inline DentedSurface plane(int n, double width)
{
  return dented(makeGrid(n + 1, n * width));
}

/// An ellipsoid of given half axes, of 20 x 4^splits triangles.
inline Mesh makeEllipsoid(int splits, const Eigen::Vector3d& axes)
{
  Mesh mesh = makeSphere(1.0, splits);
  for (Eigen::Vector3d& point : mesh.points)
  {
    point = point.cwiseProduct(axes);
  }
  return mesh;
}

inline DentedSurface ellipsoid(int splits, const Eigen::Vector3d& axes)
{
  return dented(makeEllipsoid(splits, axes));
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
