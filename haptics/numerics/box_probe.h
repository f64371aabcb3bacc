#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace palp
{

/// A place that asks many boxes how far they are, in single precision as they are, for a distance
/// that is never too large.
class BoxProbe
{
public:
  /// @param place  [m]
  explicit BoxProbe(const Eigen::Vector3d& place) noexcept
  {
    const auto rounding = static_cast<float>(place.cwiseAbs().maxCoeff()) * kRounding;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto nearest = static_cast<float>(place[static_cast<Eigen::Index>(k)]);
      low_[k] = nearest - rounding;
      high_[k] = nearest + rounding;
    }
  }

  /// Of a distance that is shorter by up to a millionth of the coordinates [m^2].
  /// @param box  its corners low and high, three floats each [m]
  /// @realtime   pure; no allocation, no lock, no exception
  [[nodiscard]] float squaredDistance(const auto& box) const noexcept
  {
    float sum = 0.0F;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const float gap = std::max(std::max(box.low[k] - high_[k], low_[k] - box.high[k]), 0.0F);
      sum += gap * gap;
    }
    return (1.0F - kRounding) * sum;
  }

private:
  static constexpr float kRounding = 4.0F * std::numeric_limits<float>::epsilon(); // [-]

  std::array<float, 3> low_{};
  std::array<float, 3> high_{};
};

} // namespace palp
