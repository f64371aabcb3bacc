#include "calibration/organ/cut_grid.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

constexpr int kParts = kCubeParts;

// where a vertical line leaves or enters the body
struct Crossing
{
  double z;
  int way; // 1: into the body, going up; -1: out of it
};

// twice the area of a triangle in the plane, seen from above
double area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double x, double y)
{
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

// vertical lines through the points of the cubes
class Lines
{
public:
  Lines(const Eigen::Vector3d& low, double step, int columns, int rows)
    : low_(low)
    , step_(step)
    , columns_(columns)
    , rows_(rows)
    , crossings_(at(columns) * at(rows))
  {
  }

  // notes where the lines pass through a triangle
  void cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
  {
    const double whole = area(a, b, c.x(), c.y());
    const auto [firstColumn, lastColumn] =
      within(std::minmax({ a.x(), b.x(), c.x() }), 0, columns_);
    const auto [firstRow, lastRow] = within(std::minmax({ a.y(), b.y(), c.y() }), 1, rows_);
    for (int j = firstRow; j <= lastRow && whole != 0.0; ++j)
    {
      for (int i = firstColumn; i <= lastColumn; ++i)
      {
        const double u = area(b, c, place(0, i), place(1, j)) / whole;
        const double v = area(c, a, place(0, i), place(1, j)) / whole;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0)
        {
          crossings_[at(j) * at(columns_) + at(i)].push_back(
            { u * a.z() + v * b.z() + (1.0 - u - v) * c.z(), whole > 0.0 ? -1 : 1 });
        }
      }
    }
  }

  // calls use(layer) for the points of a line that are inside, of so many layers
  template <typename Use>
  void forInside(int column, int row, int layers, Use use)
  {
    std::vector<Crossing>& line = crossings_[at(row) * at(columns_) + at(column)];
    std::ranges::sort(line, {}, &Crossing::z);
    int inside = 0;
    std::size_t next = 0;
    for (int layer = 0; layer < layers; ++layer)
    {
      for (; next < line.size() && line[next].z <= low_.z() + step_ * (layer + 0.5); ++next)
      {
        inside += line[next].way;
      }
      inside > 0 ? use(layer) : void();
    }
  }

private:
  [[nodiscard]] double place(Eigen::Index axis, int i) const
  {
    constexpr double aside[] = { 1e-7, 1.4e-7 }; // so that no line meets an edge [-]
    return low_[axis] + step_ * (i + 0.5 + aside[axis]);
  }

  [[nodiscard]] std::pair<int, int> within(
    std::pair<double, double> range, Eigen::Index axis, int count) const
  {
    return { std::max(0, static_cast<int>(std::floor((range.first - low_[axis]) / step_ - 0.6))),
      std::min(count - 1, static_cast<int>(std::ceil((range.second - low_[axis]) / step_ - 0.4))) };
  }

  Eigen::Vector3d low_;
  double step_;
  int columns_;
  int rows_;
  std::vector<std::vector<Crossing>> crossings_;
};

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

CubePoints CutGrid::inside(const Cube& cube) const noexcept
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (cube[k] < 0 || cube[k] >= size_[k])
    {
      return {};
    }
  }
  const std::size_t index = (at(cube[2]) * at(size_[1]) + at(cube[1])) * at(size_[0]) + at(cube[0]);
  return points_[index];
}

std::vector<Cube> CutGrid::largestPiece(double least) const
{
  const auto& [nx, ny, nz] = size_;
  const auto index = [&](const Cube& c)
  { return (at(c[2]) * at(size_[1]) + at(c[1])) * at(size_[0]) + at(c[0]); };
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
          if (filled(cube) >= least && !met[index(cube)])
          {
            met[index(cube)] = true;
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
  const int columns = size_[0] * kParts;
  const int rows = size_[1] * kParts;
  Lines lines(low_, side_ / kParts, columns, rows);
  const std::span<const Eigen::Vector3d> points = surface.points();
  for (const auto& [a, b, c] : surface.triangles())
  {
    lines.cross(points[at(a)], points[at(b)], points[at(c)]);
  }
  points_.assign(at(size_[0]) * at(size_[1]) * at(size_[2]), CubePoints());
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      lines.forInside(i, j, size_[2] * kParts,
        [&](int layer)
        {
          CubePoints& cube =
            points_[(at(layer / kParts) * at(size_[1]) + at(j / kParts)) * at(size_[0]) +
              at(i / kParts)];
          cube.set(at((layer % kParts * kParts + j % kParts) * kParts + i % kParts));
        });
    }
  }
}

} // namespace palp
