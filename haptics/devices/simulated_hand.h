#pragma once

#include "haptics/devices/device.h"
#include "haptics/servo/latest.h"

namespace palp
{

/// Mechanics of an arm and hand that hold a tool.
///
/// The defaults are the fit to one typical subject holding the handle of a haptic robot.
/// @source  van Beek, Bergmann Tiest, Mugge, Kappers, "Haptic perception of force magnitude and its
///          relation to postural arm dynamics in 3D", Scientific Reports 5, 18004, 2015, Fig. 3
struct HandMechanics
{
  double mass = 0.554;      ///< [kg], above 0
  double damping = 6.45;    ///< [N s/m], 0 or more
  double stiffness = 135.0; ///< of the muscles toward the target [N/m], 0 or more
};

/// Where a hand wants the apex of the tool, and how it holds it.
struct HandTarget
{
  Eigen::Vector3d apex = Eigen::Vector3d::Zero();   ///< [m]
  Eigen::Vector3d axis = -Eigen::Vector3d::UnitZ(); ///< unit vector from handle to apex
  bool lifted = false; ///< nothing is in the way: a tool without mass may appear there at once
};

/// A hand without a device: a mass with a damper, pulled to a target by the spring of its muscles.
class SimulatedHand final : public Device
{
public:
  /// @param start      the hand rests there, with its target at the same place
  /// @param mechanics  within the ranges of HandMechanics
  /// @throws Error     BadValue: a value out of its range
  explicit SimulatedHand(const HandTarget& start, const HandMechanics& mechanics = {});

  /// Moves the target; main thread only. A target that is not finite is ignored.
  void moveTo(const HandTarget& target);

  [[nodiscard]] DeviceLimits limits() const override;

  /// Implicit in spring and damper, so that it is stable for any tick.
  [[nodiscard]] std::optional<ToolPose> exchange(
    const Eigen::Vector3d& force, double dt) noexcept override;

private:
  HandMechanics mechanics_;
  Latest<HandTarget> target_;
  ToolPose pose_;
};

} // namespace palp
