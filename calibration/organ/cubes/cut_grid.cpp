#include "calibration/organ/cubes/cut_grid.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

struct Polygon // convex, of a triangle that is cut by six planes
{
  std::array<Eigen::Vector3d, 9> corners{};
  std::size_t count = 0;

  void add(const Eigen::Vector3d& corner)
  {
    corners[count++] = corner;
  }

  // what is on the side of a plane across an axis
  [[nodiscard]] Polygon cut(Eigen::Index axis, double bound, double side) const
  {
    Polygon kept;
    for (std::size_t i = 0; i < count; ++i)
    {
      const Eigen::Vector3d& from = corners[i];
      const Eigen::Vector3d& to = corners[(i + 1) % count];
      const double start = side * (from[axis] - bound);
      const double end = side * (to[axis] - bound);
      start >= 0.0 ? kept.add(from) : void();
      if ((start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0))
      {
        kept.add(from + start / (start - end) * (to - from));
      }
    }
    return kept;
  }

  // over its shadow on the plane z = 0, negative from below; exact to the second order
  template <typename Value>
  [[nodiscard]] Eigen::Vector4d integral(const Value& value) const
  {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (std::size_t i = 2; i < count; ++i)
    {
      const Eigen::Vector3d& a = corners[0];
      const Eigen::Vector3d& b = corners[i - 1];
      const Eigen::Vector3d& c = corners[i];
      const Eigen::Vector3d first = b - a;
      const Eigen::Vector3d second = c - a;
      const double area = 0.5 * (first.x() * second.y() - first.y() * second.x());
      sum += area / 3.0 *
        (value(Eigen::Vector3d(0.5 * (a + b))) + value(Eigen::Vector3d(0.5 * (b + c))) +
          value(Eigen::Vector3d(0.5 * (c + a))));
    }
    return sum;
  }
};

// What of a column of cubes, one above the other along z, is inside a closed surface: exactly, by
// the prisms below its triangles. Lengths are in parts of cubes.
class CutColumn
{
public:
  using Corners = std::array<Eigen::Vector3d, 3>;

  // x, y: its corner; layers: of parts
  CutColumn(double x, double y, int layers);

  // of the surface; what of it is beside the column does not matter
  void add(const Corners& corners);

  [[nodiscard]] std::vector<CubePoints> cubes() const;

private:
  using Sums = Eigen::Vector4d; // moments x, y, z and the volume

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

std::array<double, 2> rangeOf(const CutColumn::Corners& corners, Eigen::Index axis)
{
  const auto [least, most] = std::minmax({ corners[0][axis], corners[1][axis], corners[2][axis] });
  return { least, most };
}

CutColumn::CutColumn(double x, double y, int layers)
  : x_(x)
  , y_(y)
  , layers_(layers)
{
  for (Stack& stack : stacks_)
  {
    stack.within.assign(at(layers), Sums::Zero());
    stack.over.assign(at(layers), Sums::Zero());
  }
}

void CutColumn::add(const Corners& corners)
{
  const auto [left, right] = rangeOf(corners, 0);
  const auto [front, back] = rangeOf(corners, 1);
  for (int j = 0; j < kCubeParts; ++j)
  {
    for (int i = 0; i < kCubeParts; ++i)
    {
      const double x = x_ + i;
      const double y = y_ + j;
      left<x + 1.0 && right> x&& front<y + 1.0 && back> y
        ? addTo(stacks_[at(j * kCubeParts + i)], corners, x, y)
        : void();
    }
  }
}

void CutColumn::addTo(Stack& stack, const Corners& corners, double x, double y) const
{
  Polygon all;
  for (const Eigen::Vector3d& corner : corners)
  {
    all.add(corner);
  }
  all = all.cut(0, x, 1.0).cut(0, x + 1.0, -1.0).cut(1, y, 1.0).cut(1, y + 1.0, -1.0);
  if (all.count < 3)
  {
    return;
  }
  const auto [low, high] = rangeOf(corners, 2);
  const int first = std::clamp(static_cast<int>(std::floor(low)), 0, layers_ - 1);
  const int last = std::clamp(static_cast<int>(std::floor(high)), 0, layers_ - 1);
  for (int layer = first; layer <= last; ++layer)
  {
    const double z = layer;
    const Polygon in =
      all.cut(2, z, layer == first ? 0.0 : 1.0).cut(2, z + 1.0, layer == last ? 0.0 : -1.0);
    stack.within[at(layer)] += in.integral(
      [z](const Eigen::Vector3d& p)
      {
        const double height = p.z() - z;
        return Sums(p.x() * height, p.y() * height, 0.5 * (p.z() + z) * height, height);
      });
    stack.over[at(layer)] +=
      in.integral([](const Eigen::Vector3d& p) { return Sums(p.x(), p.y(), 0.0, 1.0); });
  }
}

std::vector<CubePoints> CutColumn::cubes() const
{
  constexpr double kNothing = 1e-6;
  std::vector<CubePoints> cubes(at(layers_ / kCubeParts));
  for (int k = 0; k < kCubeParts * kCubeParts; ++k)
  {
    const Stack& stack = stacks_[at(k)];
    Sums over = Sums::Zero();
    for (int layer = layers_ - 1; layer >= 0; --layer)
    {
      Sums sums = stack.within[at(layer)] + over;
      sums.z() += (layer + 0.5) * over[3];
      over += stack.over[at(layer)];
      if (sums[3] > kNothing)
      {
        const int cube = layer / kCubeParts;
        const auto part = at(layer % kCubeParts * kCubeParts * kCubeParts + k);
        const Eigen::Vector3d corner(x_, y_, cube * kCubeParts);
        cubes[at(cube)].part[part] = static_cast<float>(std::min(1.0, sums[3]));
        cubes[at(cube)].middle[part] =
          ((sums.head<3>() / sums[3] - corner) / kCubeParts).cast<float>();
      }
    }
  }
  return cubes;
}

constexpr int kEmpty = -1; // kinds of cubes
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
  const int kind = contains(cube) ? kinds_[indexOf(cube)] : kEmpty;
  return kind == kEmpty ? empty : kind == kWhole ? whole : cut_[at(kind)];
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
