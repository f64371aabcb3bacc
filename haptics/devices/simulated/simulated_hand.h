#pragma once

#include "haptics/devices/device.h"
#include "haptics/devices/simulated/guided_tool.h"

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

/// A hand without a device: a mass with a damper, pulled by the spring of its muscles to where a
/// tool without mass would be.
class SimulatedHand final : public Device
{
public:
  /// @param start      the hand rests there until its tool is steered
  /// @param mechanics  within the ranges of HandMechanics
  /// @throws Error     BadValue: a value out of its range
  explicit SimulatedHand(const ToolPose& start, const HandMechanics& mechanics = {});

  [[nodiscard]] GuidedTool* guided() noexcept override
  {
    return &tool_;
  }
  [[nodiscard]] DeviceLimits limits() const override;

  /// Implicit in spring and damper, so that it is stable for any tick.
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench& wrench, double dt) noexcept override;

private:
  HandMechanics mechanics_;
  GuidedTool tool_;
  ToolPose pose_;
};

} // namespace palp
