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
constexpr double kTolerance = 1e-5;    // of the depth [m]
constexpr double kRounding = 1e-8;     // [m]
constexpr double kNear = 0.003;        // from its place, the tool is there [m]
constexpr double kSame = 0.001;        // places are one [m]
constexpr double kHighest = 0.015;     // above a place, to come down from [m]
constexpr double kLongestPath = 0.060; // along the surface [m]
constexpr double kCloser = 1e-4;       // less is no progress [m]
constexpr double kBlocked = 0.050;     // without progress far from the place [s]
constexpr double kSettled = 0.300;     // without progress near it [s]
constexpr double kMostTilt = 1.1;      // to the surface; beyond, the tool slips over an edge [rad]
constexpr double kStill = 1e-10;       // motion of a tick that is none [m]

// what is left of a vector without its part along a unit vector
Eigen::Vector3d across(const Eigen::Vector3d& vector, const Eigen::Vector3d& direction)
{
  return vector - vector.dot(direction) * direction;
}

// fraction of a gap to close in a tick: a first-order lag whose speed is bounded
double fractionOf(double gap, double dt) noexcept
{
  const double lag = dt / (GuidedTool::kLagTime + dt);
  return gap * lag > GuidedTool::kSpeed * dt ? GuidedTool::kSpeed * dt / gap : lag;
}

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
  if (target.position.allFinite() && target.normal.allFinite() && std::isfinite(target.depth))
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
  const bool changed = target != goal_ || version_ != world_->version;
  now_.pose.velocity.setZero();
  if (!target || !(dt > 0.0) || (resting_ && !changed))
  {
    return now_.pose;
  }
  if (changed)
  {
    take(*target);
  }
  const Eigen::Vector3d before = now_.pose.apex;
  const Eigen::Vector3d axis = now_.pose.axis;
  const double tick = std::min(dt, kLongestTick);
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
  const Eigen::Vector3d motion = now_.pose.apex - before;
  if (motion.norm() <= 2.0 * kSpeed * tick) // the tool did not appear elsewhere
  {
    now_.pose.velocity = motion / dt;
  }
  watch(tick);
  const bool isStill = motion.norm() < kStill && (now_.pose.axis - axis).norm() < kStill;
  const bool isPressed = stalled_ > kSettled && target->depth > 0.0 && !lifting_ && mayStay(now_);
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
  goal_ = target;
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
  return std::min(goal_->depth, 0.5 * rayExit(tree, contact.center, -contact.normal).distance);
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
  if (!pressing || lifting_ || !mayStay(now_))
  {
    withdraw(kSpeed * dt);
  }
  else
  {
    slide(dt);
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

// false where the tool does not fit
bool GuidedTool::appear() noexcept
{
  constexpr double kStep = 0.001; // [m]
  for (double height = kHover; height <= kHighest;)
  {
    const Trial above = at(goal_->position + height * goal_->normal, -goal_->normal);
    if (!above.contact.touching())
    {
      now_ = above;
      approached_ = goal_->position;
      lifting_ = false;
      return true;
    }
    if (above.contact.normal.dot(goal_->normal) <= 0.0)
    {
      return false; // something else is above the place
    }
    height += std::max(kStep, above.contact.depth);
  }
  return false;
}

void GuidedTool::rise(double reach) noexcept
{
  const Trial higher = at(now_.pose.apex - reach * now_.pose.axis, now_.pose.axis);
  const bool isLow = across(now_.pose.apex - goal_->position, goal_->normal).norm() > kNear ||
    (now_.pose.apex - goal_->position).dot(goal_->normal) < kHover;
  if (isLow && !higher.contact.touching())
  {
    now_ = higher;
  }
}

// out of the tissue, the way that leads out soonest
void GuidedTool::withdraw(double reach) noexcept
{
  const double wanted = lifting_ ? 0.0 : deepest(now_);
  const double step = std::min(reach, now_.contact.depth - wanted + kRounding);
  Trial best = now_;
  for (const Eigen::Vector3d& direction :
    { now_.contact.normal, Eigen::Vector3d(-now_.pose.axis), goal_->normal })
  {
    const Trial out = at(now_.pose.apex + step * direction, now_.pose.axis);
    best = out.contact.depth < best.contact.depth ? out : best;
  }
  constexpr double kSlow = 0.5; // of the step
  if (best.contact.depth < now_.contact.depth - kSlow * step)
  {
    now_ = best;
  }
  else if (!appear()) // wedged between walls
  {
    now_ = { .pose = start_, .contact = {} };
  }
}

// moved along its contact normal, by secants, until it is as deep as wanted and as it may be
GuidedTool::Trial GuidedTool::settled(Trial trial, double depth, double reach) const noexcept
{
  constexpr int kAttempts = 6;
  double slope = 1.0; // of the depth over the step; more between walls
  for (int i = 0; i < kAttempts && trial.contact.touching(); ++i)
  {
    const double excess = trial.contact.depth - std::min(depth, deepest(trial));
    if (std::abs(excess) < kRounding)
    {
      break;
    }
    const double step = std::max(excess / slope, -reach);
    const Trial next = at(trial.pose.apex + step * trial.contact.normal, trial.pose.axis);
    slope = std::clamp((trial.contact.depth - next.contact.depth) / step, 0.5 * slope, 8.0 * slope);
    if (next.contact.touching())
    {
      trial = next;
    }
    else
    {
      slope *= 2.0; // it went too far
    }
  }
  return trial;
}

void GuidedTool::descend(double dt) noexcept
{
  const Eigen::Vector3d offset = gap();
  const double fraction = fractionOf(offset.norm(), dt);
  const Trial next = settled(
    at(now_.pose.apex + fraction * offset, turned(now_.pose.axis, -goal_->normal, fraction)),
    HUGE_VAL, 0.0);
  if (mayStay(next))
  {
    now_ = next;
  }
}

void GuidedTool::slide(double dt) noexcept
{
  const Contact before = now_.contact;
  const Eigen::Vector3d offset = across(gap(), before.normal);
  const double fraction = fractionOf(offset.norm(), dt);
  const double reach = kSpeed * dt;
  // under a wall that the press does not aim at, the tool goes no deeper
  constexpr double kAimed = 0.5;
  const double missing = std::max(0.0, deepest(now_) - before.depth);
  const bool isAimed = before.normal.dot(goal_->normal) > kAimed;
  const double depth = before.depth + (isAimed ? missing * fractionOf(missing, dt) : 0.0);
  for (const double part : { 1.0, 0.5, 0.25, 0.0 })
  {
    const Eigen::Vector3d apex = now_.pose.apex + part * fraction * offset;
    const Eigen::Vector3d axis = turned(now_.pose.axis, -goal_->normal, part * fraction);
    const Trial next = settled(at(apex, axis), depth, reach);
    const bool keepsPace = (next.pose.apex - now_.pose.apex).norm() <= 2.0 * reach;
    if (next.contact.touching() && keepsPace && mayStay(next))
    {
      now_ = next;
      break;
    }
  }
}

} // namespace palp
