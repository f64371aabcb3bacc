#include "haptics/devices/pointer.h"

#include "haptics/devices/turn.h"
#include "haptics/error.h"

#include <algorithm>
#include <cmath>

namespace palp
{

Pointer::Pointer(const HandTarget& start)
  : target_(start)
  , pose_{ .apex = start.apex, .axis = start.axis }
{
  if (!start.apex.allFinite() || !start.axis.allFinite())
  {
    throw Error(ErrorCode::BadValue, "pointer: start is not finite; give a place in metres");
  }
}

void Pointer::moveTo(const HandTarget& target)
{
  if (target.apex.allFinite() && target.axis.allFinite())
  {
    target_.publish(target);
  }
}

DeviceLimits Pointer::limits() const
{
  return { .model = "mouse" };
}

std::optional<ToolPose> Pointer::exchange(const Eigen::Vector3d&, double dt) noexcept
{
  const HandTarget& target = target_.read();
  pose_.velocity.setZero();
  if (target.lifted)
  {
    pose_.apex = target.apex;
    pose_.axis = target.axis;
  }
  else if (dt > 0.0 && std::isfinite(dt))
  {
    // a first-order lag whose speed is bounded; the axis turns at the same pace
    const Eigen::Vector3d gap = target.apex - pose_.apex;
    const double wanted = gap.norm() / (kLagTime + dt);
    pose_.velocity = gap * (std::min(wanted, kSpeed) / std::max(gap.norm(), kSpeed * dt * 1e-9));
    pose_.apex += dt * pose_.velocity;
    pose_.axis = turned(pose_.axis, target.axis, dt / (kLagTime + dt));
  }
  return pose_;
}

} // namespace palp
