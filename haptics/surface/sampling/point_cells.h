#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace palp
{

/// Points by cubic cells of space, to find those that are near a place.
class PointCells
{
public:
  /// @param reach  within which points are found [m], above 0
  explicit PointCells(double reach)
    : reach_(reach)
  {
  }

  void add(std::size_t index, const Eigen::Vector3d& point)
  {
    cells_[keyOf(cellOf(point))].push_back(index);
  }

  /// @param each  called with the index of every point within reach of a place, and of some beyond
  template <typename Each>
  void near(const Eigen::Vector3d& place, Each&& each) const
  {
    const Eigen::Vector3i middle = cellOf(place);
    for (int i = 0; i < 27; ++i)
    {
      const Eigen::Vector3i step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const auto found = cells_.find(keyOf(middle + step));
      for (std::size_t k = 0; found != cells_.end() && k < found->second.size(); ++k)
      {
        each(found->second[k]);
      }
    }
  }

private:
  [[nodiscard]] Eigen::Vector3i cellOf(const Eigen::Vector3d& point) const
  {
    return (point / reach_).array().floor().cast<int>();
  }

  static std::uint64_t keyOf(const Eigen::Vector3i& cell)
  {
    constexpr std::uint64_t kMask = (1U << 21U) - 1U;
    const auto part = [&](int i) { return static_cast<std::uint64_t>(cell[i]) & kMask; };
    return part(0) << 42U | part(1) << 21U | part(2);
  }

  double reach_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

} // namespace palp
