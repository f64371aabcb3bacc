#include "calibration/organ/cut_column.h"

#include "haptics/surface/box_tree.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

// convex, of a triangle that is cut by six planes
struct Polygon
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

  // integral over its shadow on the plane z = 0, negative where it is seen from below; exact to the
  // second order
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

std::array<double, 2> rangeOf(const CutColumn::Corners& corners, Eigen::Index axis)
{
  const auto [least, most] = std::minmax({ corners[0][axis], corners[1][axis], corners[2][axis] });
  return { least, most };
}

} // namespace

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
      const bool isOver = left < x + 1.0 && right > x && front < y + 1.0 && back > y;
      isOver ? addTo(stacks_[at(j * kCubeParts + i)], corners, x, y) : void();
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

} // namespace palp
