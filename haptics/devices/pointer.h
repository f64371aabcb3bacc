#pragma once

#include "haptics/devices/device.h"
#include "haptics/devices/simulated_hand.h"
#include "haptics/servo/latest.h"

namespace palp
{

/// A tool that goes where the mouse says, whatever the force: the jumps of a mouse become motion.
class Pointer final : public Device
{
public:
  static constexpr double kSpeed = 0.25;    ///< at most [m/s], a quick stroke of a hand
  static constexpr double kLagTime = 0.020; ///< to close most of a short gap [s]

  /// @param start    the tool rests there
  /// @throws Error   BadValue: not finite
  explicit Pointer(const HandTarget& start);

  /// Moves the target; main thread only. A target that is not finite is ignored.
  void moveTo(const HandTarget& target);

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] std::optional<ToolPose> exchange(
    const Eigen::Vector3d& force, double dt) noexcept override;

private:
  Latest<HandTarget> target_;
  ToolPose pose_;
};

} // namespace palp
