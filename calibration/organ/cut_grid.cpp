#include "calibration/organ/cut_grid.h"

#include "calibration/organ/cut_column.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

constexpr int kEmpty = -1;
constexpr int kWhole = -2;

CubePoints wholeCube()
{
  CubePoints cube;
  for (std::size_t i = 0; i < CubePoints::size(); ++i)
  {
    cube.set(i);
  }
  return cube;
}

} // namespace

CutGrid::CutGrid(const Surface& surface, double side)
  : side_(side)
{
  if (!surface.closed())
  {
    throw Error(ErrorCode::BadMesh,
      "the surface is open, so it has no inside; close it, palp check --repair --close-holes does");
  }
  if (const auto& crossing = surface.crossing())
  {
    throw Error(ErrorCode::BadMesh,
      "the surface crosses itself, as at " + units::inMillimeters(crossing->x()) + ", " +
        units::inMillimeters(crossing->y()) + ", " + units::inMillimeters(crossing->z()) +
        "; mend it where it was made, palp check lists where");
  }
  low_ = surface.points().front();
  Eigen::Vector3d high = low_;
  for (const Eigen::Vector3d& point : surface.points())
  {
    low_ = low_.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  double cubes = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto k = static_cast<Eigen::Index>(axis);
    constexpr double rounding = 1e-6;
    const double count = std::max(1.0, std::ceil((high[k] - low_[k]) / side - rounding));
    cubes *= count;
    size_[axis] = static_cast<int>(std::min(count, 1e6));
  }
  constexpr double most = 2e7;
  if (cubes > most)
  {
    throw Error(ErrorCode::BadValue, "the cells are too small for the body; give larger ones");
  }
  fill(surface);
}

const CubePoints& CutGrid::inside(const Cube& cube) const noexcept
{
  static const CubePoints empty;
  static const CubePoints whole = wholeCube();
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (cube[k] < 0 || cube[k] >= size_[k])
    {
      return empty;
    }
  }
  const int kind = kinds_[indexOf(cube)];
  return kind == kEmpty ? empty : kind == kWhole ? whole : cut_[at(kind)];
}

std::vector<Cube> CutGrid::largestPiece(double least) const
{
  const auto& [nx, ny, nz] = size_;
  std::vector<bool> met(at(nx) * at(ny) * at(nz));
  std::vector<Cube> largest;
  for (int k = 0; k < nz; ++k)
  {
    for (int j = 0; j < ny; ++j)
    {
      for (int i = 0; i < nx; ++i)
      {
        std::vector<Cube> piece;
        const auto visit = [&](const Cube& cube)
        {
          if (filled(cube) >= least && !met[indexOf(cube)])
          {
            met[indexOf(cube)] = true;
            piece.push_back(cube);
          }
        };
        visit({ i, j, k });
        std::size_t next = 0;
        while (next < piece.size())
        {
          const Cube cube = piece[next++];
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            for (const int step : { -1, 1 })
            {
              Cube beside = cube;
              beside[axis] += step;
              visit(beside);
            }
          }
        }
        largest = piece.size() > largest.size() ? std::move(piece) : largest;
      }
    }
  }
  return largest;
}

void CutGrid::fill(const Surface& surface)
{
  const auto& [nx, ny, nz] = size_;
  const double parts = kCubeParts / side_;
  const auto cornersOf = [&](const Triangle& triangle)
  {
    CutColumn::Corners corners;
    for (std::size_t k = 0; k < 3; ++k)
    {
      corners[k] = parts * (surface.points()[at(triangle[k])] - low_);
    }
    return corners;
  };
  std::vector<std::vector<std::size_t>> over(at(nx) * at(ny)); // triangles, of each column
  for (std::size_t t = 0; t < surface.triangles().size(); ++t)
  {
    const CutColumn::Corners corners = cornersOf(surface.triangles()[t]);
    const Eigen::Vector3d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]) / kCubeParts;
    const Eigen::Vector3d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]) / kCubeParts;
    for (int j = static_cast<int>(low.y()); j < std::min(ny, static_cast<int>(high.y()) + 1); ++j)
    {
      for (int i = static_cast<int>(low.x()); i < std::min(nx, static_cast<int>(high.x()) + 1); ++i)
      {
        over[at(j) * at(nx) + at(i)].push_back(t);
      }
    }
  }
  kinds_.assign(at(nx) * at(ny) * at(nz), kEmpty);
  for (int j = 0; j < ny; ++j)
  {
    for (int i = 0; i < nx; ++i)
    {
      CutColumn column(i * kCubeParts, j * kCubeParts, nz * kCubeParts);
      for (const std::size_t t : over[at(j) * at(nx) + at(i)])
      {
        column.add(cornersOf(surface.triangles()[t]));
      }
      const std::vector<CubePoints> cubes = column.cubes();
      for (int k = 0; k < nz; ++k)
      {
        const CubePoints& cube = cubes[at(k)];
        int& kind = kinds_[indexOf({ i, j, k })];
        kind = cube.all() ? kWhole : cube.count() > 0 ? static_cast<int>(cut_.size()) : kEmpty;
        kind >= 0 ? cut_.push_back(cube) : void();
      }
    }
  }
}

} // namespace palp
