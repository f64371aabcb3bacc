#include "haptics/devices/simulated/scripted_device.h"

#include <utility>

namespace palp
{

ScriptedDevice::ScriptedDevice(ScriptedPath path, const Eigen::Vector3d& missingAxis)
  : path_(std::move(path))
  , missingAxis_(missingAxis)
  , head_(path_.duration())
  , last_(path_.knots().front().apex)
{
}

DeviceLimits ScriptedDevice::limits() const
{
  return { .model = "scripted path" };
}

std::optional<ToolPose> ScriptedDevice::exchange(const Wrench&, double dt) noexcept
{
  bool jumps = head_.obey(order_.read());
  if (lifted_ > 0.0)
  {
    lifted_ -= dt > 0.0 ? dt : 0.0;
    (void)head_.advance(0.0);
  }
  else
  {
    jumps |= head_.advance(dt);
  }
  reached_.store(head_.time(), std::memory_order_relaxed);

  ToolPose pose = path_.poseAt(path_.startTime() + head_.time(), missingAxis_);
  pose.velocity *= head_.rate();
  if (jumps && (pose.apex - last_).norm() > kNext)
  {
    lifted_ = kLiftTime;
  }
  last_ = pose.apex;
  if (lifted_ > 0.0)
  {
    pose.apex -= kLift * pose.axis;
    pose.velocity.setZero();
  }
  return pose;
}

} // namespace palp
