#include "haptics/devices/simulated/guided_tool.h"

#include "haptics/devices/turn.h"
#include "haptics/error.h"
#include "haptics/surface/ray.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kLongestTick = 0.005; // that the tool moves in [s]
constexpr double kLongestLed = 0.05;   // likewise, to a target with a speed
constexpr double kTolerance = 1e-5;    // of the depth [m]
constexpr double kSame = 0.001;        // places are one [m]
constexpr double kLongestPath = 0.060; // along the surface [m]
constexpr double kCloser = 1e-4;       // less is no progress [m]
constexpr double kBlocked = 0.050;     // without progress far from the place [s]
constexpr double kSettled = 0.300;     // without progress near it [s]
constexpr double kMostTilt = 1.1;      // to the surface; beyond, the tool slips over an edge [rad]
constexpr double kStill = 1e-10;       // motion of a tick that is none [m]

} // namespace

GuidedTool::GuidedTool(const ToolPose& start)
  : now_{ .pose = { .apex = start.apex, .axis = start.axis }, .contact = {} }
  , start_(now_.pose)
{
  if (!start.apex.allFinite() || !start.axis.allFinite())
  {
    throw Error(ErrorCode::BadValue, "tool: its start is not finite; give a position in meters");
  }
}

void GuidedTool::moveTo(const PressTarget& target)
{
  if (target.position.allFinite() && target.normal.allFinite() && std::isfinite(target.depth) &&
    std::isfinite(target.speed))
  {
    target_.publish(target);
  }
}

void GuidedTool::setScene(const Scene& scene)
{
  scene_.publish(scene);
}

const ToolPose& GuidedTool::advance(double dt, bool mayAppear) noexcept
{
  world_ = &scene_.read();
  const std::optional<PressTarget>& target = target_.read();
  const bool changed = target != asked_ || version_ != world_->version;
  now_.pose.velocity.setZero();
  if (!target || !(dt > 0.0) || (resting_ && !changed))
  {
    return now_.pose;
  }
  if (changed)
  {
    take(*target);
  }
  goal_->depth = depthAfter(dt);
  const Eigen::Vector3d before = now_.pose.apex;
  const Eigen::Vector3d axis = now_.pose.axis;
  const bool wasApart = !now_.contact.touching();
  const double tick = std::min(dt, target->speed > 0.0 ? kLongestLed : kLongestTick);
  if (version_ != world_->version)
  {
    version_ = world_->version;
    now_ = at(now_.pose.apex, now_.pose.axis);
    for (int i = 0; i < 8 && now_.contact.depth > deepest(now_); ++i)
    {
      withdraw(HUGE_VAL); // another tip: what was deep enough may be too deep
    }
  }
  move(tick, mayAppear);
  if (wasApart && goal_->speed > 0.0)
  {
    goal_->depth = now_.contact.touching() ? now_.contact.depth : 0.0;
  }
  const Eigen::Vector3d motion = now_.pose.apex - before;
  const double pace = std::max(kSpeed * tick, goal_->speed * dt);
  if (motion.norm() <= 2.0 * pace) // the tool did not appear elsewhere
  {
    now_.pose.velocity = motion / dt;
  }
  watch(tick);
  const bool isStill = motion.norm() < kStill && (now_.pose.axis - axis).norm() < kStill;
  const bool isPressed = stalled_ > kSettled && target->depth > 0.0 &&
    goal_->depth == target->depth && !lifting_ && mayStay(now_);
  resting_ = mayAppear && (now_.contact.touching() ? isPressed : isStill);
  return now_.pose;
}

void GuidedTool::take(const PressTarget& target) noexcept
{
  if (approached_ && (target.position - *approached_).norm() > kSame)
  {
    approached_.reset();
  }
  const bool isUnderWay =
    goal_ && now_.contact.touching() && (goal_->position - now_.contact.center).norm() > kNear;
  const Eigen::Vector3d before = isUnderWay ? gap() : Eigen::Vector3d::Zero();
  asked_ = goal_ = target;
  if (target.speed > 0.0)
  {
    goal_->depth = now_.contact.touching() ? now_.contact.depth : 0.0;
  }
  if (isUnderWay)
  {
    closest_ += (gap() - before).norm();
  }
  else
  {
    closest_ = HUGE_VAL;
    stalled_ = 0.0;
  }
}

// how deep the tool is to be after a tick: by its speed from the depth before, or at once
double GuidedTool::depthAfter(double dt) const noexcept
{
  const double missing = asked_->depth - goal_->depth;
  const double most = asked_->speed > 0.0 ? asked_->speed * dt : HUGE_VAL;
  return goal_->depth + std::clamp(missing, -most, most);
}

// from the apex to where it would be in a body without curvature
Eigen::Vector3d GuidedTool::gap() const noexcept
{
  return goal_->position - goal_->depth * goal_->normal - now_.pose.apex;
}

void GuidedTool::watch(double dt) noexcept
{
  const double distance = gap().norm();
  stalled_ = distance < closest_ - kCloser ? 0.0 : stalled_ + dt;
  closest_ = stalled_ > 0.0 ? closest_ : distance;
}

GuidedTool::Trial GuidedTool::at(
  const Eigen::Vector3d& apex, const Eigen::Vector3d& axis) const noexcept
{
  Trial trial{ .pose = { .apex = apex, .axis = axis }, .contact = {}, .touch = now_.touch };
  if (world_->surface != nullptr)
  {
    trial.contact = touchOrgan(*world_, trial.pose, trial.touch);
  }
  return trial;
}

// how deep the tool may be in a contact
double GuidedTool::deepest(const Trial& trial) const noexcept
{
  const auto& [pose, contact, touch] = trial;
  if (!contact.touching())
  {
    return goal_->depth;
  }
  const BoxTree& tree = organOf(*world_, touch.organ).surface->tree();
  const double below = rayExit(tree, contact.center, -contact.normal).distance;
  return std::min(goal_->depth, 0.5 * std::min(below, contact.thickness));
}

bool GuidedTool::mayStay(const Trial& trial) const noexcept
{
  return trial.contact.depth <= deepest(trial) + kTolerance && !(trial.contact.tilt > kMostTilt);
}

void GuidedTool::move(double dt, bool mayAppear) noexcept
{
  const bool pressing = goal_->depth > 0.0;
  if (world_->surface == nullptr)
  {
    const double height = pressing ? -goal_->depth : kHover;
    now_ = at(goal_->position + height * goal_->normal, -goal_->normal);
    return;
  }
  if (!now_.contact.touching())
  {
    lifting_ = false;
    if (pressing && isAbove())
    {
      descend(dt);
    }
    else if (mayAppear)
    {
      appear();
    }
    else
    {
      rise(kSpeed * dt);
    }
    return;
  }
  lifting_ = pressing && (lifting_ || mustLift());
  const bool hasSpeed = goal_->speed > 0.0; // and may be less deep than it was
  if (pressing && !lifting_ && (hasSpeed || mayStay(now_)))
  {
    slide(dt);
  }
  if (!pressing || lifting_ || !mayStay(now_))
  {
    withdraw(hasSpeed && !lifting_ ? HUGE_VAL : kSpeed * dt);
  }
}

// in the air, on the line on which the place is pressed
bool GuidedTool::isAbove() const noexcept
{
  const Eigen::Vector3d offset = now_.pose.apex - goal_->position;
  const double height = offset.dot(goal_->normal);
  return across(offset, goal_->normal).norm() < kNear && height > -goal_->depth - kNear &&
    height < kHighest + kNear && now_.pose.axis.dot(goal_->normal) < 0.0;
}

// whether the path along the surface is none
bool GuidedTool::mustLift() const noexcept
{
  const Eigen::Vector3d offset = goal_->position - now_.contact.center;
  const double length = offset.norm();
  if (length < kNear || approached_)
  {
    return false; // it is there, or as near as the surface lets it
  }
  constexpr double kSteep = 0.3; // cosine between the offset and the surface
  return length > kLongestPath || now_.pose.axis.dot(goal_->normal) > 0.0 ||
    across(offset, now_.contact.normal).norm() < kSteep * length || stalled_ > kBlocked;
}

} // namespace palp
