#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace palp
{

/// Time-domain passivity control: books the energy that the loop has given to the hand, and damps
/// the hand while it has given more than it took.
///
/// The observed energy counts the force that really went to the device, held over the tick, times
/// the way the device then went: this is the exact energy at the port, also between the samples.
///
/// @source  Hannaford, Ryu, "Time-domain passivity control of haptic interfaces", IEEE TRA 2002
class PassivityController
{
public:
  /// @param maxDamping  alpha_max [N s/m]
  /// @param quantum     smallest step of the positions [m]; its noise is no velocity to damp
  explicit PassivityController(double maxDamping, double quantum = 0.0) noexcept
    : maxDamping_(maxDamping)
    , atRest_(std::min(kAtRest, quantum / kTick))
  {
  }

  /// Books the last tick, and gives the damping force of this one.
  ///
  /// @param position  of the device now [m]
  /// @param velocity  [m/s]
  /// @param dt        [s], above 0
  /// @return          [N], against the velocity, or zero
  /// @realtime        no allocation, no lock, no exception
  [[nodiscard]] Eigen::Vector3d damp(
    const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double dt) noexcept;

  /// The force that went to the device, after every limit [N].
  void sent(const Eigen::Vector3d& force) noexcept
  {
    sent_ = force;
  }

  /// Credit of this contact cannot pay for activity in the next; a debt stays.
  void leaveContact() noexcept
  {
    energy_ = std::min(energy_, 0.0);
  }

  /// Forgets all, at the start of a device or after a gap in its poses.
  void restart(const Eigen::Vector3d& position) noexcept;

  /// Energy taken from the hand [J]; negative: given to it.
  [[nodiscard]] double energy() const noexcept
  {
    return energy_;
  }

private:
  static constexpr double kAtRest = 1e-3; // [m/s], for a coarse encoder
  static constexpr double kTick = 1e-3;   // in which one step of a fine one is noise [s]

  double maxDamping_;
  double atRest_; // [m/s]
  double energy_ = 0.0;
  Eigen::Vector3d sent_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
};

} // namespace palp
