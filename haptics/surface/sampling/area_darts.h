#pragma once

#include "haptics/surface/surface.h"
#include "haptics/surface/surface_point.h"

#include <cstddef>
#include <functional>
#include <random>
#include <vector>

namespace palp
{

/// 0 to 1, the same on every machine.
[[nodiscard]] inline double uniform(std::mt19937_64& engine)
{
  return static_cast<double>(engine() >> 11U) * 0x1p-53;
}

/// Random places of a surface, as many as there is area; none on the wall of a hollow, where no
/// tool gets.
class AreaDarts
{
public:
  /// @param surface  outlives this object
  /// @param isIn     whether places of a triangle are wanted
  AreaDarts(const Surface& surface, const std::function<bool(std::size_t triangle)>& isIn);

  /// Of what is wanted [m^2].
  [[nodiscard]] double area() const noexcept
  {
    return area_;
  }

  /// Call it only where there is an area.
  [[nodiscard]] SurfacePoint next(std::mt19937_64& engine) const;

private:
  const Surface& surface_;
  double area_ = 0.0;
  std::vector<std::size_t> triangles_;
  std::vector<double> sums_; // of the areas so far [m^2]
};

/// The corners of a triangle [m].
struct Corners
{
  Eigen::Vector3d a, b, c;
};

[[nodiscard]] inline Corners cornersOf(const Surface& surface, std::size_t triangle)
{
  const Triangle& points = surface.triangles()[triangle];
  const auto point = [&](std::size_t k)
  { return surface.points()[static_cast<std::size_t>(points[k])]; };
  return { point(0), point(1), point(2) };
}

} // namespace palp
