#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

namespace palp
{

/// The quadric of planes, of which each stands for an area: ten numbers instead of a matrix of
/// sixteen, as millions of them are read in no order.
///
/// @source  Garland and Heckbert, "Surface simplification using quadric error metrics", 1997
class Planes
{
public:
  /// @param normal  unit vector
  /// @param off     the plane is where normal * x + off = 0 [m]
  /// @param area    [m^2]
  void add(const Eigen::Vector3d& normal, double off, double area)
  {
    const std::array plane{ normal.x(), normal.y(), normal.z(), off };
    std::size_t k = 0;
    for (std::size_t i = 0; i < plane.size(); ++i)
    {
      for (std::size_t j = i; j < plane.size(); ++j)
      {
        sums_[k++] += area * plane[i] * plane[j];
      }
    }
  }

  void add(const Planes& other)
  {
    std::ranges::transform(sums_, other.sums_, sums_.begin(), std::plus());
  }

  /// The sum of the areas times the squared distances of a place [m^4].
  [[nodiscard]] double at(const Eigen::Vector3d& place) const
  {
    const auto& [aa, ab, ac, ad, bb, bc, bd, cc, cd, dd] = sums_;
    const double x = place.x();
    const double y = place.y();
    const double z = place.z();
    return x * (aa * x + 2.0 * (ab * y + ac * z + ad)) + y * (bb * y + 2.0 * (bc * z + bd)) +
      z * (cc * z + 2.0 * cd) + dd;
  }

private:
  std::array<double, 10> sums_{}; // of the products of a, b, c, d: aa, ab, ac, ad, bb, ..., dd
};

} // namespace palp
