#include "haptics/devices/hid/rate_motion.h"

namespace palp
{

DriverSample RateMotion::move(SpaceMouseState& state, bool heard, double dt) noexcept
{
  constexpr double kRest = 0.1; // [s]
  silent_ = heard ? 0.0 : silent_ + dt;
  if (silent_ > kRest)
  {
    state.axes = {};
  }
  position_ += dt * velocityOf(state, rate_);
  const Eigen::Vector3d turn = dt * angularVelocityOf(state, rate_);
  const double angle = turn.norm();
  if (angle > 0.0)
  {
    orientation_ =
      (Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle)) * orientation_).normalized();
  }
  return { .position = position_, .orientation = orientation_, .buttons = state.buttons };
}

} // namespace palp
