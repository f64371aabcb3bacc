#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace palp
{

/// Velocity from the positions of an encoder, over a window that adapts to the motion.
///
/// Takes the longest window over which a straight line from its oldest position to the newest
/// passes within one quantum of every position between: long and quiet in slow motion, short and
/// prompt in quick motion. The delay is half the window.
///
/// @source  first-order adaptive windowing: Janabi-Sharifi, Hayward, Chen, IEEE TCST 8(6), 2000
class VelocityEstimator
{
public:
  static constexpr double kLongestDelay = 0.0045; ///< at periods of at most 9 ms [s]

  /// @param quantum  smallest step of the positions, per axis [m]; 0 gives the backward difference
  explicit VelocityEstimator(double quantum) noexcept
    : quantum_(quantum)
  {
  }

  /// @param position  newest [m]
  /// @param dt        since the one before [s]
  /// @return          [m/s]; zero until there are two positions
  /// @realtime        no allocation, no lock, no exception
  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& position, double dt) noexcept;

private:
  static constexpr std::size_t kPositions = 41; // 10 ms at 4 kHz

  // the i-th newest
  [[nodiscard]] std::size_t slot(std::size_t i) const noexcept
  {
    return (newest_ + kPositions - i) % kPositions;
  }

  [[nodiscard]] double axis(int which) const noexcept;

  double quantum_;
  std::array<Eigen::Vector3d, kPositions> positions_;
  std::array<double, kPositions> ages_{}; // [s]
  std::size_t newest_ = 0;
  std::size_t count_ = 0;
};

} // namespace palp
