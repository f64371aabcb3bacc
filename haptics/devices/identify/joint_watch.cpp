#include "haptics/devices/identify/joint_watch.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

std::string deadJoint(std::size_t joint)
{
  return "the encoder of joint " + std::to_string(joint + 1) +
    " does not count though its motor pushes it; the encoder or its cable may be dead, or the "
    "joint is held";
}

} // namespace

std::string JointWatch::take(const std::optional<DriverJoints>& now, double time)
{
  constexpr double kStands = 0.1; // longer than between two directions [s]
  constexpr double kLag = 0.02;   // a force that turns each few milliseconds moves nothing [s]
  constexpr double kMore = 1.25;  // friction is not alike in all places
  constexpr double kShare = 0.25; // less hardly tells: other joints push back
  if (!now)
  {
    return "";
  }
  constexpr double kMost = 0.005; // of a computer that was late: an exchange tells but once [s]
  const double passed = std::min(time - before_.value_or(time), kMost);
  std::string wrong;
  for (std::size_t i = 0; i < joints_.size(); ++i)
  {
    const double angle = now->angles[static_cast<int>(i)];
    Joint& joint = joints_[i];
    joint.push += std::min(1.0, passed / kLag) * (now->torques[static_cast<int>(i)] - joint.push);
    const double torque = std::abs(joint.push);
    joint.largest = std::max(joint.largest, torque);
    if (before_ && angle != joint.angle)
    {
      joint.counts = true;
      joint.stands = 0.0;
    }
    joint.withstood = joint.counts ? joint.withstood : joint.largest;
    const double least = std::max(kMore * joint.withstood, kShare * joint.largest);
    joint.stands += torque > least ? passed : -std::min(passed, joint.stands);
    joint.angle = angle;
    wrong = knows_ && joint.stands > kStands ? deadJoint(i) : wrong;
  }
  before_ = time;
  return wrong;
}

std::string JointWatch::neverCounted()
{
  knows_ = true;
  std::ranges::for_each(joints_, [](Joint& joint) { joint.stands = 0.0; });
  const auto still = std::ranges::find(joints_, false, &Joint::counts);
  return before_ && still != joints_.end()
    ? deadJoint(static_cast<std::size_t>(still - joints_.begin()))
    : "";
}

} // namespace palp
