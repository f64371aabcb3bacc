#pragma once

#include "haptics/contact/ball/rim_angle.h"
#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

namespace palp
{

/// The part of one side of a triangle within a ball; integrals over it take the whole side as 1.
struct CutSide
{
  Eigen::Vector3d vector; ///< from its first corner to the next [m]
  double squared;         ///< length of the side [m^2]
  double first; ///< q, the squared distance to the ball's center, at its first corner [m^2]
  double along; ///< of the first corner and the side [m^2]
  double cross; ///< of its two corners, about the triangle's normal [m^2]
  bool isIn;    ///< whether it meets the ball
  double enter; ///< of the side, where it is in
  double leave; ///< likewise

  [[nodiscard]] double length() const noexcept
  {
    return leave - enter;
  }
  /// Of q [m^2].
  [[nodiscard]] double squares() const noexcept
  {
    constexpr double kThird = 1.0 / 3.0;
    return length() *
      (first + along * (enter + leave) +
        kThird * squared * (enter * enter + enter * leave + leave * leave));
  }
  /// q at a part of the side [m^2].
  [[nodiscard]] double squaredAt(double part) const noexcept
  {
    return first + part * (2.0 * along + part * squared);
  }
};

/// How a ball of the squared radius Q cuts a triangle.
struct CutTriangle
{
  static constexpr std::array<std::size_t, 3> kNext{ 1, 2, 0 };

  /// As far as the corners tell: sides are cut only when that is called for.
  /// @param squaredRadius  Q [m^2], above 0
  /// @realtime             pure; no allocation, no lock, no exception
  CutTriangle(const Facet& facet, const Eigen::Vector3d& center, double squaredRadius) noexcept;

  /// @return    whether the ball reaches the triangle
  /// @realtime  no allocation, no lock, no exception
  bool cutSides(double squaredRadius) noexcept;

  /// Whether all of it is in the ball.
  [[nodiscard]] bool isWhole(double squaredRadius) const noexcept
  {
    return q[0] <= squaredRadius && q[1] <= squaredRadius && q[2] <= squaredRadius;
  }
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] double area() const noexcept
  {
    return 0.5 * tripleProduct(disc.normal, corners[1] - corners[0], corners[2] - corners[0]);
  }
  /// Calls use(Arc) for each way along the rim of the disc within the triangle.
  template <typename Use>
  void eachArc(Use use) const noexcept
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      if (sides[k].isIn && sides[k].leave < 1.0)
      {
        std::size_t next = kNext[k];
        while (!sides[next].isIn)
        {
          next = kNext[next];
        }
        const Eigen::Vector3d from = corners[k] + sides[k].leave * sides[k].vector;
        const Eigen::Vector3d to = corners[next] + sides[next].enter * sides[next].vector;
        use(Arc{ from, to, from.dot(to) - disc.height * disc.height,
          tripleProduct(disc.normal, from, to) });
      }
    }
  }

  std::array<Eigen::Vector3d, 3> corners; ///< from the center of the ball [m]
  std::array<double, 3> q;                ///< of the corners [m^2]
  Disc disc;
  std::array<CutSide, 3> sides; ///< unset before they are cut: clearing them took time
  bool isStraight = false; ///< the disc's rim, as good as: integrals over its sectors would be all
                           ///< rounding
};

} // namespace palp
