#pragma once

#include "haptics/devices/device.h"
#include "haptics/servo/coupling.h"
#include "haptics/servo/guards/drive_guard.h"
#include "haptics/servo/guards/oscillation_guard.h"
#include "haptics/servo/passivity.h"
#include "haptics/servo/period_monitor.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"
#include "haptics/servo/tissue_memory.h"

#include <optional>

namespace palp
{

/// How a safety chain behaves; the defaults are those of every device.
struct SafetySettings
{
  double period = 0.001;          ///< T of the loop [s]
  double stiffnessFraction = 0.7; ///< of the stable stiffness that is used [-]
  double passivityDamping = 2.0;  ///< alpha_max [N s/m]
  double slewRate = 500.0;        ///< [N/s]; what a fault ends falls with its decay besides
  double softSlewRate = 50.0;     ///< while a force starts [N/s]
  double softStart = 0.5;         ///< from zero to full force [s]
  double decay = 0.1;             ///< from full force to zero [s]
  double fastest = 2.0;           ///< a hand [m/s]; what is faster is a fault
  bool deadMan = false;           ///< force only while the first button is held
};

/// What the user and the program say in a tick.
struct SafetyOrders
{
  bool armed = false; ///< a fault is forgiven when this becomes true anew, without a stop
  bool stop = false;  ///< emergency stop
  /// Of the main thread [s]. What it knows of the world is trusted for 0.2 s and not at all after
  /// 0.3 s; after 2 s, when no stop button can work, its silence is an emergency stop.
  double heartbeatAge = 0.0;
};

/// Everything between a force law and a hand, in a fixed order, unconditional.
///
/// Finite and plausible pose; the law through a coupling of bounded stiffness; damping; passivity;
/// the end of the workspace; the largest force; its largest rate; soft start and decay. Each tick
/// is admit, then contact and law by the caller, then limit. Belongs to the servo thread.
///
/// Whenever the law or the surface changes under the tool, or the force has to start in contact,
/// the contact is rebased: felt from a depth at which no force jumps, until the tool has lifted.
/// So a change cannot give energy to the hand.
class SafetyChain
{
public:
  /// @throws Error  BadValue: a setting or a limit of the device that is not positive where it must
  ///                be, or a softSlewRate that is not below slewRate
  explicit SafetyChain(const DeviceLimits& device, const SafetySettings& settings = {});

  /// First half of a tick: may this pose be used, and is force allowed?
  ///
  /// @param pose    of Device::exchange
  /// @param dt      since the last tick [s]
  /// @return        a finite pose that a hand can have reached; nothing: there is no pose
  /// @realtime      no allocation, no lock, no exception
  [[nodiscard]] std::optional<ToolPose> admit(const std::optional<ToolPose>& pose,
    const DeviceStatus& status, const SafetyOrders& orders, double dt) noexcept;

  /// Second half of a tick: sets force, torque, proxyDepth, flags and state of a sample.
  ///
  /// @param sample  pose and contact of this tick
  /// @param law     at this contact
  /// @param scene   for damping, largest force and version
  /// @param tissue  whose law this is, which may push the tool aside and turn it; null: it does
  ///                not
  /// @param memory  of it, to settle where the tool is felt to be; null: none
  /// @realtime      no allocation, no lock, no exception
  void limit(Sample& sample, const DepthLaw& law, const Scene& scene,
    const TissueAt* tissue = nullptr, TissueMemory* memory = nullptr) noexcept;

  [[nodiscard]] DeviceState state() const noexcept
  {
    return state_;
  }

  /// Stiffness that may be rendered now [N/m], for a damping of the law [N s/m], of which no more
  /// than twice that of the device is rendered. See stableStiffness: a hand as the device states it
  /// is on it; without one, passivity control and OscillationGuard hold what is rendered.
  [[nodiscard]] double stiffnessLimit(double damping) const noexcept;

  /// From a pose to the force that answers it: of 99 in 100 as the device measures them, or as it
  /// was stated [s].
  [[nodiscard]] double delay() const noexcept;

  /// Energy that the port has taken from the hand, by the force really sent [J].
  [[nodiscard]] double energy() const noexcept
  {
    return passivity_.energy();
  }

private:
  void beginTick(const DeviceStatus& status, double elapsed) noexcept;
  [[nodiscard]] bool plausible(const ToolPose& pose, double age) noexcept;
  void advance(const DeviceStatus& status, const SafetyOrders& orders) noexcept;
  void fault(Flag flag) noexcept;
  void forceOff(DeviceState state) noexcept;
  [[nodiscard]] Eigen::Vector3d rendered(Sample& sample, const DepthLaw& law, const Scene& scene,
    const TissueAt* tissue, TissueMemory* memory) noexcept;
  void rebase(const DepthLaw& law, double depth, double stiffest, bool changed) noexcept;
  void followLean(const Sample& sample, const Scene& scene) noexcept;
  void resumeFraction() noexcept;
  [[nodiscard]] double highestNormalForce(const Scene& scene) const noexcept;
  [[nodiscard]] Eigen::Vector3d push(
    const Contact& contact, const Rendered& felt, const Scene& scene) noexcept;
  [[nodiscard]] double torqueStiffnessLimit(const Scene& scene) const noexcept;
  [[nodiscard]] Eigen::Vector3d renderedTorque(
    const Sample& sample, const Scene& scene, const TissueAt& tissue) const noexcept;
  [[nodiscard]] double renderedDamping(double wanted) const noexcept;
  [[nodiscard]] Eigen::Vector3d workspaceForce(const ToolPose& pose) noexcept;
  void watchSwings(const Sample& sample) noexcept;
  [[nodiscard]] Eigen::Vector3d bounded(Eigen::Vector3d force, double largest) noexcept;
  [[nodiscard]] double largestForce(const Scene& scene) const noexcept;
  void ramp(bool touching) noexcept;
  void fade() noexcept;
  void raise(Flag flag) noexcept
  {
    flags_ |= static_cast<std::uint32_t>(flag);
  }
  [[nodiscard]] bool forceOn() const noexcept
  {
    return state_ == DeviceState::SoftStart || state_ == DeviceState::Active ||
      state_ == DeviceState::Decay;
  }

  DeviceLimits device_;
  SafetySettings settings_;
  PassivityController passivity_;
  OscillationGuard guard_;
  DriveGuard drive_;
  PeriodMonitor period_;
  PeriodMonitor delays_;
  bool measured_ = false;                             // the device tells its delay
  double newestDelay_ = 0.0;                          // [s]
  double stored_ = 0.0;                               // in the rendered springs [J]
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();  // of the workspace, now [m]
  double elapsed_ = 0.0;                              // since the last tick, as it was [s]
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ(); // of the last contact

  DeviceState state_ = DeviceState::Closed;
  std::uint32_t flags_ = 0;   // of this tick
  std::uint32_t latched_ = 0; // faults that wait to be forgiven
  bool wasArmed_ = false;     // last tick
  double dt_ = 0.0;           // of this tick, bounded [s]
  double gain_ = 0.0;         // fraction of the largest force that may be, of the force in decay
  double share_ = 0.0;        // of the force that is sent while it decays or the device is silent
  double watchdogGain_ = 0.0; // less than 1 while the device is silent
  double apart_ = 0.0;        // time without contact [s]
  int restarts_ = 0;          // after late ticks, since the force was last whole

  ToolPose last_;          // admitted
  double sinceLast_ = 0.0; // [s]
  double lastAge_ = 0.0;   // of it, when it was admitted [s]
  int dropped_ = 0;        // poses in a row

  double contactOffset_ = 0.0; // depth at which contact is felt to begin [m]
  double lean_ = 0.0;          // of that, what the tool became deeper by leaning [m]
  Eigen::Vector3d axis_ = -Eigen::Vector3d::UnitZ(); // of the tool, last tick
  double normalForce_ = 0.0;  // of the law through the coupling, last tick [N]
  bool rebase_ = false;       // the force has to start in contact
  std::uint64_t version_ = 0; // of the scene, last tick
  int organ_ = 0;             // of the sample, last tick
  bool touched_ = false;      // it

  Eigen::Vector3d shaped_ = Eigen::Vector3d::Zero(); // before gain, last tick [N]
  Eigen::Vector3d sent_ = Eigen::Vector3d::Zero();   // last tick [N]
  Eigen::Vector3d fading_ = Eigen::Vector3d::Zero(); // rest of a force that was let go [N]
};

} // namespace palp
