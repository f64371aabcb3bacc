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
  std::vector<std::pair<Range*, std::uint32_t>> reached;
  for (std::uint32_t i = 0; i < places_.size(); ++i)
  {
    forCellsWithin(places_[i].position.cast<double>(),
      [&](Range& cell)
      {
        ++cell.last;
        cell.isBesideEdge |= places_[i].beside > 0.0F;
        reached.emplace_back(&cell, i);
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
  for (const auto& [cell, i] : reached)
  {
    near_[cell->last++] = i;
  }
}

template <typename Visit>
void ComplianceField::forCellsWithin(const Eigen::Vector3d& position, const Visit& visit)
{
  const int around = static_cast<int>(std::ceil(reach_ / cell_));
  const Cell middle = cellOf(position);
  const int side = 2 * around + 1;
  for (int k = 0; k < side * side * side; ++k)
  {
    const Cell cell{ middle[0] + k % side - around, middle[1] + k / side % side - around,
      middle[2] + k / (side * side) - around };
    const Eigen::Vector3d low = cell_ * Eigen::Vector3d(cell[0], cell[1], cell[2]);
    const Eigen::Vector3d nearest =
      position.cwiseMax(low).cwiseMin(low + Eigen::Vector3d::Constant(cell_));
    if ((nearest - position).squaredNorm() < reach_ * reach_)
    {
      visit(cells_[keyOf(cell)]);
    }
  }
}

} // namespace palp
