#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <array>
#include <span>
#include <vector>

class vtkPolyData;

namespace palp
{

/// Where the values at the corners of triangles, interpolated between them, are one value.
struct LevelLines
{
  /// On the edge between two corners.
  struct Point
  {
    int from; ///< below the level
    int to;   ///< at it, or above
    float t;  ///< 0 to 1, from the first
  };

  std::vector<Point> points;             ///< one for each edge that is crossed
  std::vector<std::array<int, 2>> lines; ///< of points, one for each triangle that is crossed
};

/// Lets go of lines without length. The toolkit's own filter takes several times as long.
///
/// @param values  at the corners
[[nodiscard]] LevelLines levelLines(
  std::span<const Triangle> triangles, std::span<const float> values, float level);

/// The same of a surface in single precision.
///
/// @param triangles  its own
/// @param values     name of an array of it
/// @param vectors    name of another, of three numbers, which the lines get between the corners
/// @param lines      empty, or others so made, to which these are added
void addLevelLines(vtkPolyData& surface, std::span<const Triangle> triangles, const char* values,
  const char* vectors, float level, vtkPolyData& lines);

} // namespace palp
