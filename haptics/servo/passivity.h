#pragma once

#include "haptics/pose.h"
#include "haptics/wrench.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>

namespace palp
{

/// What dissipates in the mechanism whatever the loop does, and pays for a part of its activity.
struct Dissipation
{
  double damping = 0.0;  ///< [N s/m]
  double friction = 0.0; ///< Coulomb's [N]
};

/// What a passivity controller has to know of a tick.
struct PortTick
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< of the device now [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(); ///< [m/s]
  Eigen::Vector3d axis = -Eigen::Vector3d::UnitZ();   ///< of the tool, unit
  double dt = 0.001;                                  ///< since the last tick [s], above 0
  double delay = 0.0;  ///< of a force, behind the pose it answers [s]
  double stored = 0.0; ///< in the rendered springs, which the hand may have back [J]
  double share = 1.0;  ///< of alpha_max that may be used [-]
};

/// Time-domain passivity control: observes the energy that the port has taken from the hand, and
/// damps the hand while less is left than the rendered springs store.
///
/// Passivity observer: each wrench that really went to the device, times the motion and turn on
/// which it acted: those of a delay later, split between ticks. For a force that is held over a
/// tick this is the energy at the port, also between the samples, to within a step of the encoder
/// times the force. Passivity controller: a variable damper that dissipates what is missing, after
/// what the mechanism dissipates by itself.
///
/// @source  Hannaford, Ryu, "Time-domain passivity control of haptic interfaces", IEEE TRA 18(1),
///          2002; stored energy as reference: Ryu, Preusche, Hannaford, Hirzinger, "Time domain
///          passivity control with reference energy following", IEEE TCST 13(5), 2005
class PassivityController
{
public:
  /// @param maxDamping  alpha_max [N s/m]
  /// @param quantum     smallest step of the positions [m]; its noise is no velocity to damp
  explicit PassivityController(
    double maxDamping, double quantum = 0.0, const Dissipation& mechanism = {}) noexcept
    : maxDamping_(maxDamping)
    , quantum_(quantum)
    , atRest_(std::min(kAtRest, quantum / kTick))
    , mechanism_(mechanism)
  {
  }

  /// Books the last tick, and gives the damping force of this one.
  ///
  /// @return          [N], against the velocity, or zero
  /// @realtime        no allocation, no lock, no exception
  [[nodiscard]] Eigen::Vector3d damp(const PortTick& tick) noexcept;

  /// What answers the pose of this tick, after every limit.
  void sent(const Wrench& wrench) noexcept
  {
    wrenches_[newest_] = wrench;
  }

  /// What the motors were given of the newest force, by a driver with limits of its own [N].
  void given(const Eigen::Vector3d& force) noexcept
  {
    wrenches_[newest_].force = force;
  }

  /// Credit of this contact cannot pay for activity in the next; a debt stays.
  void leaveContact() noexcept
  {
    balance_ = std::min(balance_, 0.0);
  }

  /// Forgets all, at the start of a device or after a gap in its poses.
  void restart(const ToolPose& pose) noexcept;

  [[nodiscard]] double maxDamping() const noexcept
  {
    return maxDamping_;
  }

  /// Observed energy, taken from the hand [J]; negative: given to it.
  [[nodiscard]] double energy() const noexcept
  {
    return energy_;
  }

private:
  static constexpr double kAtRest = 1e-3;     // [m/s], for a coarse encoder
  static constexpr double kTick = 1e-3;       // in which one step of a fine one is noise [s]
  static constexpr std::size_t kForces = 128; // 32 ms at 4 kHz

  [[nodiscard]] Eigen::Vector3d within(const PortTick& tick) const noexcept;
  [[nodiscard]] Wrench acting(double dt, double delay) const noexcept;

  double maxDamping_;
  double quantum_; // [m]
  double atRest_;  // [m/s]
  Dissipation mechanism_;
  double energy_ = 0.0;
  double balance_ = 0.0; // the same with what the mechanism dissipates, between its bounds [J]
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero(); // as well as it is known [m]
  Eigen::Vector3d read_ = Eigen::Vector3d::Zero();  // of the encoder [m]
  Eigen::Vector3d axis_ = -Eigen::Vector3d::UnitZ();
  std::array<Wrench, kForces> wrenches_{};
  std::array<double, kForces> lengths_{}; // from the pose of each force to the next [s]
  std::size_t newest_ = 0;
};

} // namespace palp
