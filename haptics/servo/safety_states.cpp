// Whether there may be a force: poses, faults and states. How large it may be is in safety.cpp.

#include "haptics/servo/safety.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kAxisTolerance = 0.01; // of the length of a unit vector
constexpr int kMaxDropped = 3;          // poses in a row that may be implausible
constexpr double kShortest = 1e-6;      // tick [s]
constexpr double kLatest = 0.005;       // [s], or kLatestTicks periods if that is longer
constexpr double kLatestTicks = 5.0;
constexpr int kMaxRestarts = 5; // of a force that late ticks let never become whole

// an age of the heartbeat that is borne at first, then lets the force fade, then ends it [s]
struct HeartbeatAge
{
  double borne;
  double ends;

  [[nodiscard]] double watchdogGain(double age) const noexcept
  {
    return age < ends ? std::min(1.0, (ends - age) / (ends - borne)) : 0.0;
  }
};
constexpr HeartbeatAge kDeviceHeartbeat{ 0.003, 0.020 };
constexpr HeartbeatAge kMainThreadHeartbeat{ 0.200, 0.300 };
constexpr double kMainThreadGone = 2.0; // [s]
constexpr double kWarm = 0.8;           // of the heat at which motors give less, which is told

} // namespace

std::optional<ToolPose> SafetyChain::admit(const std::optional<ToolPose>& pose,
  const DeviceStatus& status, const SafetyOrders& orders, double dt) noexcept
{
  flags_ = 0;
  const double elapsed = dt >= 0.0 && std::isfinite(dt) ? dt : settings_.period;
  beginTick(status, elapsed);
  const bool stopped = orders.stop || status.stopped || !(orders.heartbeatAge <= kMainThreadGone);
  if (orders.armed && !wasArmed_ && !stopped) // a new wish forgives
  {
    latched_ = 0;
    restarts_ = 0;
  }
  wasArmed_ = orders.armed;
  if (stopped)
  {
    fault(Flag::EmergencyStop);
  }

  if (!pose)
  {
    fault(Flag::DeviceLost);
    forceOff(DeviceState::Closed);
    return std::nullopt;
  }
  if (!pose->apex.allFinite() || !pose->velocity.allFinite() ||
    !(std::abs(pose->axis.norm() - 1.0) < kAxisTolerance))
  {
    fault(Flag::NotFinite);
    return state_ == DeviceState::Closed ? std::nullopt : std::optional(last_);
  }
  // nothing follows from where it was said to be before it was there, or knew its zero
  const bool isNew = state_ == DeviceState::Closed || state_ == DeviceState::NeedsHoming;
  if (isNew)
  {
    state_ = state_ == DeviceState::Closed ? DeviceState::Opening : state_;
    passivity_.restart(*pose);
  }
  if (isNew || plausible(*pose, status.age))
  {
    last_ = *pose;
    lastAge_ = status.age;
    sinceLast_ = 0.0;
    dropped_ = 0;
  }
  const double late = elapsed - settings_.period;
  if (late > std::max(kLatest, kLatestTicks * settings_.period) * (1.0 + 1e-9) && forceOn())
  {
    raise(Flag::Late);
    forceOff(DeviceState::SoftStart);
    fading_ = sent_;
    if (++restarts_ > kMaxRestarts)
    {
      fault(Flag::Late);
    }
  }
  advance(status, orders);
  return last_;
}

// times of this tick, and what the last one came to at the motors
void SafetyChain::beginTick(const DeviceStatus& status, double elapsed) noexcept
{
  dt_ = std::clamp(elapsed, 0.5 * settings_.period, 4.0 * settings_.period);
  sinceLast_ += std::max(elapsed, dt_);
  period_.record(elapsed);
  elapsed_ = std::max(elapsed, kShortest);
  center_ = device_.workspaceCenter + status.moved;
  if (status.delay > 0.0)
  {
    measured_ = true;
    newestDelay_ = status.delay;
    delays_.record(status.delay);
  }
  if (status.sent && status.sent->allFinite())
  {
    passivity_.given(*status.sent);
  }
  if (status.heat > kWarm)
  {
    raise(Flag::MotorsWarm);
  }
}

// keeps the last pose for a few ticks; after them the new place is true, but without force
bool SafetyChain::plausible(const ToolPose& pose, double age) noexcept
{
  // a pose that was told again while the device was silent is as old as it was the first time
  const double moving = sinceLast_ + std::max(0.0, lastAge_ - age);
  if ((pose.apex - last_.apex).norm() <= settings_.fastest * moving)
  {
    return true;
  }
  raise(Flag::Jump);
  last_.velocity.setZero();
  if (++dropped_ <= kMaxDropped)
  {
    return false;
  }
  fault(Flag::Jump);
  passivity_.restart(pose);
  rebase_ = true;
  return true;
}

void SafetyChain::advance(const DeviceStatus& status, const SafetyOrders& orders) noexcept
{
  watchdogGain_ = std::min(kDeviceHeartbeat.watchdogGain(status.age),
    kMainThreadHeartbeat.watchdogGain(orders.heartbeatAge));
  if (!(status.age < kDeviceHeartbeat.ends))
  {
    fault(Flag::Stale);
  }
  const bool watched = orders.heartbeatAge < kMainThreadHeartbeat.ends;
  if (!(orders.heartbeatAge < kMainThreadHeartbeat.borne))
  {
    raise(Flag::WatchdogExpired);
  }
  if (!watched && forceOn())
  {
    forceOff(DeviceState::Ready);
  }
  if (device_.needsHoming && !status.homed)
  {
    raise(Flag::NotHomed);
    forceOff(DeviceState::NeedsHoming);
    return;
  }
  if (state_ == DeviceState::Opening || state_ == DeviceState::NeedsHoming)
  {
    state_ = DeviceState::Ready;
  }

  const bool held = !settings_.deadMan || (status.buttons & 1U) != 0;
  if (status.clutched)
  {
    raise(Flag::Clutched);
  }
  const bool wanted = orders.armed && held && watched && !status.clutched && latched_ == 0;
  if (wanted && state_ == DeviceState::Ready)
  {
    forceOff(DeviceState::SoftStart);
  }
  else if (!wanted && forceOn())
  {
    // that of a start is a fraction of the largest force, that of a decay of the force itself
    gain_ = state_ == DeviceState::SoftStart ? 1.0 : gain_;
    state_ = DeviceState::Decay;
  }
}

// a fault is latched; most end the force at once, a jump lets it fade
void SafetyChain::fault(Flag flag) noexcept
{
  raise(flag);
  latched_ |= static_cast<std::uint32_t>(flag);
  if (flag != Flag::Jump && forceOn())
  {
    forceOff(DeviceState::Ready);
  }
}

void SafetyChain::forceOff(DeviceState state) noexcept
{
  state_ = state;
  gain_ = 0.0;
  apart_ = 0.0;
  shaped_.setZero();
  fading_.setZero();
  rebase_ = true;
}

} // namespace palp
