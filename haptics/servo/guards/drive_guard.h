#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace palp
{

/// Finds motors that push the other way, in a press, of an arm that nobody has measured: motion
/// against a force that is felt gains speed, which that force would take from it.
///
/// How a hand pushes is not known, so that nothing follows from a motion alone; what decides is
/// that a hand pushes hardly harder from one moment to the next. While a force grows, the motion
/// against it goes on as it did when that began, at most: with its speed, and with what it gained
/// of that. What is gained beyond, within kWithin, came from the motors. A hand that jerks so is
/// taken for them (10 mm at 3 Hz; not at 2 Hz); a motor in the place of another, which pushes to
/// the side, is not found.
class DriveGuard
{
public:
  static constexpr double kFelt = 0.1;     ///< [N]
  static constexpr double kGained = 0.05;  ///< [m/s]
  static constexpr double kWithin = 0.060; ///< in which no hand reacts [s]

  /// @param velocity  of the hand [m/s]
  /// @param force     on it, as it was told [N]
  /// @param dt        since the last tick [s], above 0
  /// @return          whether they disagree
  /// @realtime        no allocation, no lock, no exception
  [[nodiscard]] bool record(
    const Eigen::Vector3d& velocity, const Eigen::Vector3d& force, double dt) noexcept
  {
    const Eigen::Vector3d gains = (velocity - mean_) / kMean; // in a second
    mean_ += std::min(1.0, dt / kMean) * (velocity - mean_);
    const double size = force.norm();
    time_ += dt;
    if (size < kFelt || size < least_ || time_ > kWithin)
    {
      least_ = std::max(kFelt, size);
      time_ = 0.0;
      begun_ = velocity;
      gains_ = gains;
      return false;
    }
    const Eigen::Vector3d against = -force / size;
    const double expected = begun_.dot(against) + std::max(0.0, gains_.dot(against)) * time_;
    return velocity.dot(against) > std::max(0.0, expected) + kGained;
  }

private:
  static constexpr double kMean = 0.010; // [s]

  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero(); // velocity of the last moments [m/s]
  double least_ = kFelt; // where the look began: a hand wins over a force that falls [N]
  double time_ = 0.0;    // since then [s]
  Eigen::Vector3d begun_ = Eigen::Vector3d::Zero(); // velocity then [m/s]
  Eigen::Vector3d gains_ = Eigen::Vector3d::Zero(); // of it [m/s^2]
};

} // namespace palp
