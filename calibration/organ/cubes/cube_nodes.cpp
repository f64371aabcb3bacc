#include "calibration/organ/cubes/cube_nodes.h"

#include <cstddef>

namespace palp
{
namespace
{

constexpr int kNone = -1;

bool isSet(int corner, std::size_t axis)
{
  return ((corner >> axis) & 1) != 0;
}

Cube cornerOf(const Cube& cube, int corner)
{
  return { cube[0] + (corner & 1), cube[1] + ((corner >> 1) & 1), cube[2] + ((corner >> 2) & 1) };
}

// whether the body goes through the face between a cube and the next one along an axis: parts of
// both, on either side of it, are inside
bool isJoined(const CutGrid& grid, Cube cube, std::size_t axis)
{
  const CubePoints& before = grid.inside(cube);
  ++cube[axis];
  const CubePoints& behind = grid.inside(cube);
  constexpr std::array<std::size_t, 4> kStrides{ 1, kCubeParts, kCubeParts * kCubeParts, 1 };
  const std::size_t along = kStrides[axis];
  const std::size_t across = kStrides[(axis + 1) % 3];
  const std::size_t over = kStrides[(axis + 2) % 3];
  for (std::size_t k = 0; k < std::size_t{ kCubeParts } * kCubeParts; ++k)
  {
    const std::size_t first = k % kCubeParts * across + k / kCubeParts * over;
    if (before[first + (kCubeParts - 1) * along] && behind[first])
    {
      return true;
    }
  }
  return false;
}

} // namespace

CubeNodes::CubeNodes(const CutGrid& grid, double least)
  : grid_(grid)
{
  findCells(least);
  Corners none;
  none.fill(kNone);
  corners_.assign(cells_.size(), none);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell)
  {
    for (int corner = 0; corner < kCubeCorners; ++corner)
    {
      corners_[cell][at(corner)] == kNone ? spreadNode(cells_[cell], corner) : void();
    }
  }
}

const CubeNodes::Corners* CubeNodes::of(const Cube& cube) const noexcept
{
  const int number = numberOf(cube);
  return number == kNone ? nullptr : &corners_[at(number)];
}

int CubeNodes::numberOf(const Cube& cube) const noexcept
{
  return grid_.contains(cube) ? numbers_[grid_.indexOf(cube)] : kNone;
}

void CubeNodes::findCells(double least)
{
  const auto& [nx, ny, nz] = grid_.size();
  const std::size_t count = at(nx) * at(ny) * at(nz);
  std::vector<bool> met(count);
  double all = 0.0;
  double joined = 0.0;
  const auto fill = [&](const Cube& first)
  {
    std::vector<Cube> piece;
    double filled = 0.0;
    const auto visit = [&](const Cube& cube)
    {
      if (grid_.filled(cube) >= least && !met[grid_.indexOf(cube)])
      {
        met[grid_.indexOf(cube)] = true;
        filled += grid_.filled(cube);
        piece.push_back(cube);
      }
    };
    visit(first);
    for (std::size_t next = 0; next < piece.size(); ++next)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const Cube cube = piece[next];
        Cube before = cube;
        --before[axis];
        Cube behind = cube;
        ++behind[axis];
        isJoined(grid_, before, axis) ? visit(before) : void();
        isJoined(grid_, cube, axis) ? visit(behind) : void();
      }
    }
    all += filled;
    joined = piece.size() > cells_.size() ? filled : joined;
    piece.size() > cells_.size() ? cells_.swap(piece) : void();
  };
  grid_.forEach(grid_.low(), grid_.low() + grid_.side() * Eigen::Vector3d(nx, ny, nz), fill);
  leftOut_ = cells_.empty() ? 0.0 : 1.0 - joined / all;
  numbers_.assign(count, kNone);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell)
  {
    numbers_[grid_.indexOf(cells_[cell])] = static_cast<int>(cell);
  }
}

// to all of the eight cubes around that corner that the body goes through to, also by those that
// hold too little of it to count
void CubeNodes::spreadNode(const Cube& cell, int corner)
{
  const int node = static_cast<int>(places_.size());
  places_.push_back(grid_.cornerOf(cornerOf(cell, corner)));
  const auto cubeAround = [&](int seen) // whose corner of that number it is
  {
    Cube cube = cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cube[axis] += (isSet(corner, axis) ? 1 : 0) - (isSet(seen, axis) ? 1 : 0);
    }
    return cube;
  };
  std::array<bool, kCubeCorners> met{};
  std::vector<int> reached{ corner };
  met[at(corner)] = true;
  for (std::size_t next = 0; next < reached.size(); ++next)
  {
    const int seen = reached[next];
    const Cube cube = cubeAround(seen);
    const int number = numberOf(cube);
    number == kNone ? void() : void(corners_[at(number)][at(seen)] = node);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int other = seen ^ (1 << axis);
      // the cube that comes first along the axis has the corner at its far end
      if (!met[at(other)] && isJoined(grid_, cubeAround(seen | (1 << axis)), axis))
      {
        met[at(other)] = true;
        reached.push_back(other);
      }
    }
  }
}

} // namespace palp
