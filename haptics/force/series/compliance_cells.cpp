#include "haptics/force/series/compliance_field.h"

#include <cmath>
#include <utility>

namespace palp
{
namespace
{

std::uint64_t keyOf(const std::array<int, 3>& cell)
{
  constexpr std::uint64_t mask = (1U << 21U) - 1U;
  const auto part = [&](std::size_t i) { return static_cast<std::uint64_t>(cell[i]) & mask; };
  return part(0) << 42U | part(1) << 21U | part(2);
}

} // namespace

ComplianceField::Cell ComplianceField::cellOf(const Eigen::Vector3d& place) const noexcept
{
  return { static_cast<int>(std::floor(place.x() / cell_)),
    static_cast<int>(std::floor(place.y() / cell_)),
    static_cast<int>(std::floor(place.z() / cell_)) };
}

ComplianceField::Range ComplianceField::near(const Eigen::Vector3d& place) const noexcept
{
  const auto found = cells_.find(keyOf(cellOf(place)));
  return found != cells_.end() ? found->second : Range{};
}

// each cell knows every place that reaches into it, so that a contact looks at one cell only
void ComplianceField::sortIntoCells()
{
  constexpr std::size_t kCells = 8; // that a place brings along, about
  cells_.reserve(kCells * places_.size());
  for (const Place& place : places_)
  {
    forCellsWithin(place.position.cast<double>(),
      [&](Range& cell)
      {
        ++cell.last;
        cell.isBesideEdge |= place.beside > 0.0F;
      });
  }
  std::uint32_t count = 0;
  for (auto& [key, cell] : cells_)
  {
    const std::uint32_t first = std::exchange(count, count + cell.last);
    cell.first = first;
    cell.last = first;
  }
  near_.resize(count);
  for (std::uint32_t i = 0; i < places_.size(); ++i)
  {
    forCellsWithin(
      places_[i].position.cast<double>(), [&](Range& cell) { near_[cell.last++] = i; });
  }
}

template <typename Visit>
void ComplianceField::forCellsWithin(const Eigen::Vector3d& position, const Visit& visit)
{
  const int around = static_cast<int>(std::ceil(reach_ / cell_));
  const int side = 2 * around + 1;
  const Cell middle = cellOf(position);
  Eigen::Array3Xd gaps(3, side); // along each axis to the cells of each slab, squared
  for (int k = 0; k < side; ++k)
  {
    const Eigen::Array3d low =
      cell_ * (Eigen::Array3d(middle[0], middle[1], middle[2]) + (k - around));
    gaps.col(k) = (low - position.array()).max(position.array() - low - cell_).max(0.0).square();
  }
  for (int x = 0; x < side; ++x)
  {
    for (int y = 0; y < side; ++y)
    {
      for (int z = 0; z < side; ++z)
      {
        if (gaps(0, x) + gaps(1, y) + gaps(2, z) < reach_ * reach_)
        {
          visit(cells_[keyOf(
            { middle[0] + x - around, middle[1] + y - around, middle[2] + z - around })]);
        }
      }
    }
  }
}

} // namespace palp
