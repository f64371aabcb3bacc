#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
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
    low_.head<3>() = place.cast<float>().array() - rounding;
    high_.head<3>() = place.cast<float>().array() + rounding;
  }

  /// Of a distance that is shorter by up to a millionth of the coordinates [m^2].
  /// @param box  its corners low and high, three floats each, both with another four bytes behind
  /// @realtime   pure; no allocation, no lock, no exception
  [[nodiscard]] float squaredDistance(const auto& box) const noexcept
  {
    const auto corners = std::bit_cast<std::array<float, 8>>(box);
    const Eigen::Map<const Eigen::Array4f> low(corners.data());
    const Eigen::Map<const Eigen::Array4f> high(corners.data() + 4);
    const Eigen::Array4f gap = (low - high_).max(low_ - high).max(0.0F);
    const Eigen::Array4f squares = gap * gap;
    return (1.0F - kRounding) * (squares[0] + squares[1] + squares[2]);
  }

private:
  static constexpr float kRounding = 4.0F * std::numeric_limits<float>::epsilon(); // [-]

  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Eigen::Array4f low_{ 0.0F, 0.0F, 0.0F, -kInfinity }; // no gap to what lies behind a corner
  Eigen::Array4f high_{ 0.0F, 0.0F, 0.0F, kInfinity };
};

} // namespace palp
