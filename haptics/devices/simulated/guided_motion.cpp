// How a led tool moves in a tick: in the air, into the tissue and out of it, along the surface.

#include "haptics/devices/simulated/guided_tool.h"
#include "haptics/devices/turn.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kRounding = 1e-8; // [m]

// fraction of a gap to close in a tick: a first-order lag whose speed is bounded
double fractionOf(double gap, double dt) noexcept
{
  const double lag = dt / (GuidedTool::kLagTime + dt);
  return gap * lag > GuidedTool::kSpeed * dt ? GuidedTool::kSpeed * dt / gap : lag;
}

} // namespace

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
  const double distance = offset.norm();
  const double fraction =
    std::max(fractionOf(distance, dt), std::min(1.0, goal_->speed * dt / distance));
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
  // under a wall that the press does not aim at, the tool goes no deeper
  constexpr double kAimed = 0.5;
  const double most = before.normal.dot(goal_->normal) > kAimed ? HUGE_VAL : 0.0;
  const double missing = std::min(deepest(now_) - before.depth, most);
  const bool hasSpeed = goal_->speed > 0.0;
  const double deeper = hasSpeed ? missing : std::max(0.0, missing) * fractionOf(missing, dt);
  const double depth = before.depth + deeper;
  const double reach = std::max(kSpeed * dt, hasSpeed ? std::abs(missing) : 0.0);
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
