#include "haptics/devices/bus_device.h"

#include "haptics/error.h"

#include <cmath>
#include <exception>
#include <utility>

namespace palp
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kPeriod = 1ms;
constexpr auto kPatience = 1s;
constexpr auto kCommandAge = 20ms;
constexpr auto kReopenEvery = 500ms;
constexpr auto kLook = 10ms;          // of the watching thread
constexpr int kLastWords = 10;        // packets of zero force
constexpr double kFastestTurn = 40.0; // of a hand [rad/s]
constexpr double kSmoothing = 0.1;    // of the time of a transfer, by each one

double seconds(std::chrono::nanoseconds duration) noexcept
{
  return std::chrono::duration<double>(duration).count();
}

} // namespace

BusDevice::BusDevice(Open open, const DevicePlacement& placement)
  : open_(std::move(open))
  , driver_(open_())
  , limits_(driver_->limits())
  , placement_(placement)
  , rotation_(placement.rotation * limits_.facing)
  , velocity_(limits_.quantum)
  , watcher_([this](const std::stop_token& stop) { watch(stop); })
{
  const auto deadline = Clock::now() + kPatience;
  while (!there_ && losses_ == 0 && Clock::now() < deadline)
  {
    (void)exchange(Wrench{}, seconds(kPeriod));
    std::this_thread::sleep_for(there_ ? 0ms : kPeriod);
  }
  if (!there_)
  {
    throw Error(ErrorCode::NoDevice,
      limits_.model + ": does not answer; check its power and cable, and plug it in again");
  }
  answered_ = true; // by no servo: how long one takes to start is no delay
}

BusDevice::~BusDevice()
{
  watcher_.request_stop();
  watcher_.join();
  endForce();
}

DeviceLimits BusDevice::limits() const
{
  // a force that is felt as it is over a motion that is scaled: the tool's mechanism is that of the
  // arm by the scale
  DeviceLimits limits = limits_;
  limits.scale = placement_.scale;
  for (double* dynamic : { &limits.damping, &limits.mass, &limits.handDamping })
  {
    *dynamic /= limits.scale;
  }
  limits.quantum *= limits.scale;
  limits.workspaceRadius *= limits.scale;
  limits.workspaceCenter = limits.scale * (rotation_ * limits.workspaceCenter) + placement_.origin;
  return limits;
}

bool BusDevice::place(const DevicePlacement& placement)
{
  placement_ = placement;
  rotation_ = placement.rotation * limits_.facing;
  status_.moved.setZero();
  answered_ = true;
  held_ = false;
  heldByUser_ = false;
  heard_.buttons = 0; // a clutch that is held takes hold anew
  index(true);
  return true;
}

std::optional<ToolPose> BusDevice::exchange(const Wrench& wrench, double) noexcept
{
  const int losses = losses_.load();
  const bool wasLost = std::exchange(toldLosses_, losses) != losses;
  if (wasLost)
  {
    there_ = false;
    answered_ = true;
    velocity_ = VelocityEstimator(limits_.quantum);
  }
  const Clock::time_point begin = Clock::now();
  renewed_.store(begin, std::memory_order_relaxed);
  if (wasLost || !takeDriver())
  {
    status_.sent = Eigen::Vector3d::Zero(); // whoever has the driver sends nothing else
    status_.age = seconds(begin - when_);
    return there_ && owner_ != Owner::Lost ? std::optional(pose()) : std::nullopt;
  }
  const Clock::time_point asked = asked_;
  const IoCode code = transfer(wrench, begin, heard_);
  if (code == IoCode::Ok)
  {
    const Clock::time_point now = Clock::now();
    busTime_ += there_ ? kSmoothing * (seconds(now - begin) - busTime_) : seconds(now - begin);
    speed_ = velocity_(heard_.position, seconds(begin - asked));
    turn(seconds(begin - asked));
    asked_ = begin;
    when_ = now;
    answered_ = false;
    there_ = true;
    index(wrench.force.isZero(0.0));
  }
  releaseDriver(code);
  status_.homed = heard_.homed;
  status_.stopped = heard_.stopped;
  status_.buttons = heard_.buttons;
  status_.heat = heard_.heat;
  status_.sent =
    heard_.sent ? std::optional<Eigen::Vector3d>(rotation_ * *heard_.sent) : std::nullopt;
  status_.age = seconds(Clock::now() - when_);
  return there_ && code != IoCode::Gone ? std::optional(pose()) : std::nullopt;
}

void BusDevice::answer(const Wrench& wrench) noexcept
{
  if (!there_ || !takeDriver())
  {
    return;
  }
  DriverSample unused = heard_;
  const Clock::time_point begin = Clock::now();
  renewed_.store(begin, std::memory_order_relaxed);
  releaseDriver(transfer(wrench, begin, unused));
}

// a board looks where it is when a command comes, and that command carries the force: so from one
// to the next is the time in which a pose is answered, however long the ways are
IoCode BusDevice::transfer(
  const Wrench& wrench, Clock::time_point begin, DriverSample& sample) noexcept
{
  if (!std::exchange(answered_, true))
  {
    status_.delay = seconds(begin - asked_);
  }
  return tick(rotation_.transpose() * wrench, sample);
}

// a driver counts in this time what its motors took up, or how far its tool went
IoCode BusDevice::tick(const Wrench& wrench, DriverSample& sample) noexcept
{
  const Clock::time_point now = Clock::now();
  return driver_->tick(wrench, seconds(now - std::exchange(ticked_, now)), sample);
}

bool BusDevice::takeDriver() noexcept
{
  Owner nobody = Owner::Nobody;
  return owner_.compare_exchange_strong(nobody, Owner::User);
}

void BusDevice::releaseDriver(IoCode code) noexcept
{
  losses_ += code == IoCode::Gone ? 1 : 0;
  owner_.store(code == IoCode::Gone ? Owner::Lost : Owner::Nobody);
}

// a tracker that errs, or a grip that wakes, turns the tool no faster than a hand
void BusDevice::turn(double dt) noexcept
{
  const Eigen::Vector3d told = heard_.orientation * -Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d about = axis_.cross(told);
  const double sine = about.norm();
  const double most = kFastestTurn * dt;
  const bool leaps = there_ && sine > 0.0 && std::atan2(sine, axis_.dot(told)) > most;
  axis_ = leaps ? (Eigen::AngleAxisd(most, about / sine) * axis_).normalized() : told;
}

// a force that is still there ends while it moves with the tool that it holds; then the tool stays
void BusDevice::index(bool rests) noexcept
{
  const Eigen::Vector3d reached =
    placement_.scale * (rotation_ * heard_.position) + placement_.origin;
  const bool button =
    placement_.clutch > 0 && (heard_.buttons >> (placement_.clutch - 1) & 1U) != 0;
  status_.clutched = button || heldByUser_;
  held_ = status_.clutched && (held_ || rests || !limits_.rendersForce);
  if (held_)
  {
    status_.moved = apex_ - reached;
  }
  apex_ = reached + status_.moved;
}

ToolPose BusDevice::pose() const noexcept
{
  ToolPose pose;
  pose.apex = apex_;
  pose.axis = rotation_ * axis_;
  if (!held_)
  {
    pose.velocity = placement_.scale * (rotation_ * speed_);
  }
  return pose;
}

void BusDevice::watch(const std::stop_token& stop) noexcept
{
  while (!stop.stop_requested())
  {
    std::this_thread::sleep_for(kLook);
    if (owner_ == Owner::Lost)
    {
      reopen(stop);
    }
    else if (Clock::now() - renewed_.load(std::memory_order_relaxed) > kCommandAge && takeDriver())
    {
      DriverSample unused;
      releaseDriver(tick(Wrench{}, unused));
    }
  }
}

// also where a transfer has failed: some failures pass, and the motors hold what they heard last
void BusDevice::endForce() noexcept
{
  DriverSample unused;
  for (int i = 0; driver_ && i < kLastWords; ++i)
  {
    if (tick(Wrench{}, unused) == IoCode::Gone)
    {
      std::this_thread::sleep_for(kPeriod);
    }
  }
}

void BusDevice::reopen(const std::stop_token& stop) noexcept
{
  endForce();
  driver_.reset();
  while (!driver_ && !stop.stop_requested())
  {
    for (auto wait = 0ms; wait < kReopenEvery && !stop.stop_requested(); wait += kLook)
    {
      std::this_thread::sleep_for(kLook);
    }
    try
    {
      driver_ = open_();
      ticked_ = Clock::now();
      owner_ = Owner::Nobody;
    }
    catch (const std::exception&) // still unplugged
    {
    }
  }
}

} // namespace palp
