#include "haptics/devices/threaded_device.h"

#include "haptics/error.h"
#include "haptics/threads/realtime.h"

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
constexpr auto kLook = 10ms;   // for the end of the thread
constexpr int kLastWords = 10; // packets of zero force

double seconds(std::chrono::nanoseconds duration) noexcept
{
  return std::chrono::duration<double>(duration).count();
}

} // namespace

ThreadedDevice::ThreadedDevice(Open open, const DevicePlacement& placement)
  : open_(std::move(open))
  , driver_(open_())
  , limits_(driver_->limits())
  , placement_(placement)
  , thread_([this](const std::stop_token& stop) { run(stop); })
{
  (void)makeRealtime(thread_.native_handle(), true); // without it the bus waits for other programs
  const auto deadline = Clock::now() + kPatience;
  while (!there_ && losses_ == 0 && Clock::now() < deadline)
  {
    std::this_thread::sleep_for(kPeriod);
  }
  if (!there_)
  {
    throw Error(ErrorCode::NoDevice,
      limits_.model + ": does not answer; check its power and cable, and plug it in again");
  }
}

ThreadedDevice::~ThreadedDevice() = default; // the thread stops and joins first

DeviceLimits ThreadedDevice::limits() const
{
  DeviceLimits limits = limits_;
  limits.workspaceCenter = placement_.rotation * limits.workspaceCenter + placement_.origin;
  return limits;
}

std::optional<ToolPose> ThreadedDevice::exchange(const Eigen::Vector3d& force, double) noexcept
{
  wanted_.publish({ .force = placement_.rotation.transpose() * force, .when = Clock::now() });
  const int losses = losses_.load();
  if (std::exchange(toldLosses_, losses) != losses || !there_.load())
  {
    return std::nullopt;
  }
  const Heard& heard = heard_.read();
  status_ = { .homed = heard.sample.homed,
    .stopped = heard.sample.stopped,
    .buttons = heard.sample.buttons,
    .age = seconds(Clock::now() - heard.when) };
  ToolPose pose;
  pose.apex = placement_.rotation * heard.sample.position + placement_.origin;
  pose.velocity = placement_.rotation * heard.velocity;
  return pose;
}

void ThreadedDevice::run(const std::stop_token& stop) noexcept
{
  while (!stop.stop_requested())
  {
    serve(stop);
    if (!stop.stop_requested())
    {
      reopen(stop);
    }
  }
  endForce();
}

// until a transfer fails
void ThreadedDevice::serve(const std::stop_token& stop) noexcept
{
  VelocityEstimator velocity(limits_.quantum);
  Heard heard;
  auto last = Clock::now();
  auto lastHeard = last;
  for (auto due = last; !stop.stop_requested(); due = std::max(due + kPeriod, Clock::now()))
  {
    std::this_thread::sleep_until(due);
    const auto now = Clock::now();
    const Wanted& wanted = wanted_.read();
    const bool fresh = now - wanted.when < kCommandAge;
    const IoCode code =
      driver_->tick(fresh ? wanted.force : Eigen::Vector3d(Eigen::Vector3d::Zero()),
        seconds(now - last), heard.sample);
    last = now;
    if (code == IoCode::Gone)
    {
      return;
    }
    if (code == IoCode::Ok)
    {
      heard.when = Clock::now();
      heard.velocity = velocity(heard.sample.position, seconds(heard.when - lastHeard));
      lastHeard = heard.when;
      heard_.publish(heard);
      there_ = true;
    }
  }
}

// also where a transfer has failed: some failures pass, and the motors hold what they heard last
void ThreadedDevice::endForce() noexcept
{
  DriverSample unused;
  for (int i = 0; driver_ && i < kLastWords; ++i)
  {
    if (driver_->tick(Eigen::Vector3d::Zero(), seconds(kPeriod), unused) == IoCode::Gone)
    {
      std::this_thread::sleep_for(kPeriod);
    }
  }
}

void ThreadedDevice::reopen(const std::stop_token& stop) noexcept
{
  there_ = false;
  ++losses_;
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
    }
    catch (const std::exception&) // still unplugged
    {
    }
  }
}

} // namespace palp
