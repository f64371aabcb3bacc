#pragma once

#include "calibration/organ/cube_stiffness.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace palp
{

/// What of a column of cubes, one above the other along z, is inside a closed surface: exactly, by
/// the prisms below its triangles. Lengths are in parts of cubes.
class CutColumn
{
public:
  using Corners = std::array<Eigen::Vector3d, 3>;

  /// @param x, y    its corner
  /// @param layers  of parts
  CutColumn(double x, double y, int layers);

  /// Counts a triangle of the surface; what of it is beside the column does not matter.
  void add(const Corners& corners);

  /// After all triangles: what is inside, cube by cube from below.
  [[nodiscard]] std::vector<CubePoints> cubes() const;

private:
  // moments x, y, z and the volume
  using Sums = Eigen::Vector4d;

  // of one stack of parts
  struct Stack
  {
    std::vector<Sums> within; // of each part
    std::vector<Sums> over;   // area that is over each, times x, y, nothing and one
  };

  void addTo(Stack& stack, const Corners& corners, double x, double y) const;

  double x_;
  double y_;
  int layers_;
  std::array<Stack, std::size_t{ kCubeParts } * kCubeParts> stacks_{};
};

} // namespace palp
