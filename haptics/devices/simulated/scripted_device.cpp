#include "haptics/devices/simulated/scripted_device.h"

#include <utility>

namespace palp
{

ScriptedDevice::ScriptedDevice(ScriptedPath path, const Eigen::Vector3d& missingAxis)
  : path_(std::move(path))
  , missingAxis_(missingAxis)
{
}

DeviceLimits ScriptedDevice::limits() const
{
  return { .model = "scripted path" };
}

std::optional<ToolPose> ScriptedDevice::exchange(const Eigen::Vector3d&, double dt) noexcept
{
  elapsed_ += dt > 0.0 ? dt : 0.0;
  return path_.poseAt(path_.startTime() + elapsed_, missingAxis_);
}

} // namespace palp
