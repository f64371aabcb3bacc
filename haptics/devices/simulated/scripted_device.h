#pragma once

#include "haptics/devices/device.h"
#include "haptics/devices/simulated/scripted_path.h"

namespace palp
{

/// Plays a path in the time of its caller; no force can move it.
class ScriptedDevice final : public Device
{
public:
  /// @param path         starts to play at the first exchange
  /// @param missingAxis  unit vector that stands in where the path gives no axis
  explicit ScriptedDevice(
    ScriptedPath path, const Eigen::Vector3d& missingAxis = -Eigen::Vector3d::UnitZ());

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] std::optional<ToolPose> exchange(
    const Eigen::Vector3d& force, double dt) noexcept override;

private:
  ScriptedPath path_;
  Eigen::Vector3d missingAxis_;
  double elapsed_ = 0.0; // [s]
};

} // namespace palp
