#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <vector>

namespace palp::test
{

/// Closed surface of those cells between planes across x, y and z that are filled.
///
/// @param planes  rising, of each axis [m]
/// @param filled  of a cell by its number along each axis, from 0
inline palp::Mesh cells(const std::array<std::vector<double>, 3>& planes,
  const std::function<bool(const std::array<int, 3>&)>& filled)
{
  using Cell = std::array<int, 3>;
  palp::Mesh mesh;
  std::map<Cell, int> ids;
  const auto point = [&](const Cell& at)
  {
    const auto [entry, isNew] = ids.try_emplace(at, static_cast<int>(mesh.points.size()));
    if (isNew)
    {
      const auto along = [&](std::size_t k) { return planes[k][static_cast<std::size_t>(at[k])]; };
      mesh.points.emplace_back(along(0), along(1), along(2));
    }
    return entry->second;
  };
  const auto count = [&](std::size_t k) { return static_cast<int>(planes[k].size()) - 1; };
  const auto isFilled = [&](const Cell& cell)
  {
    bool isIn = true;
    for (std::size_t k = 0; k < 3; ++k)
    {
      isIn = isIn && cell[k] >= 0 && cell[k] < count(k);
    }
    return isIn && filled(cell);
  };
  const auto addFace = [&](Cell cell, std::size_t axis, int end)
  {
    cell[axis] += end;
    const std::size_t right = (axis + 1) % 3;
    const std::size_t up = (axis + 2) % 3;
    std::array<int, 4> corners{};
    for (int i = 0; i < 4; ++i)
    {
      Cell corner = cell;
      corner[right] += i == 1 || i == 2 ? 1 : 0;
      corner[up] += i / 2;
      corners[static_cast<std::size_t>(end == 1 ? i : 3 - i)] = point(corner);
    }
    mesh.triangles.push_back({ corners[0], corners[1], corners[2] });
    mesh.triangles.push_back({ corners[0], corners[2], corners[3] });
  };
  const int all = count(0) * count(1) * count(2);
  for (int i = 0; i < 6 * all; ++i)
  {
    const Cell cell{ i / 6 % count(0), i / 6 / count(0) % count(1), i / 6 / count(0) / count(1) };
    const auto axis = static_cast<std::size_t>(i % 3);
    const int end = i / 3 % 2;
    Cell beyond = cell;
    beyond[axis] += 2 * end - 1;
    isFilled(cell) && !isFilled(beyond) ? addFace(cell, axis, end) : void();
  }
  return mesh;
}

} // namespace palp::test
