#include "haptics/devices/threaded_device.h"

#include "haptics/error.h"

#include <utility>

namespace palp
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kPeriod = 1ms;
constexpr auto kPatience = 1s;
constexpr auto kCommandAge = 20ms;
constexpr int kLastWords = 10; // packets of zero force

double seconds(std::chrono::nanoseconds duration) noexcept
{
  return std::chrono::duration<double>(duration).count();
}

} // namespace

ThreadedDevice::ThreadedDevice(std::unique_ptr<Driver> driver, const DevicePlacement& placement)
  : driver_(std::move(driver))
  , placement_(placement)
  , thread_([this](const std::stop_token& stop) { run(stop); })
{
  const auto deadline = Clock::now() + kPatience;
  while (!spoke_.load() && !gone_.load() && Clock::now() < deadline)
  {
    std::this_thread::sleep_for(kPeriod);
  }
  if (!spoke_.load() || gone_.load())
  {
    throw Error(ErrorCode::NoDevice,
      driver_->limits().model +
        ": does not answer; check its power and cable, and plug it in again");
  }
}

ThreadedDevice::~ThreadedDevice() = default; // the thread stops and joins first

DeviceLimits ThreadedDevice::limits() const
{
  DeviceLimits limits = driver_->limits();
  limits.workspaceCenter = placement_.rotation * limits.workspaceCenter + placement_.origin;
  return limits;
}

std::optional<ToolPose> ThreadedDevice::exchange(const Eigen::Vector3d& force, double) noexcept
{
  const auto now = Clock::now();
  wanted_.publish({ .force = placement_.rotation.transpose() * force, .when = now });
  if (gone_.load(std::memory_order_relaxed))
  {
    return std::nullopt;
  }
  const Heard& heard = heard_.read();
  status_ = {
    .homed = heard.sample.homed, .buttons = heard.sample.buttons, .age = seconds(now - heard.when)
  };
  ToolPose pose;
  pose.apex = placement_.rotation * heard.sample.position + placement_.origin;
  pose.velocity = placement_.rotation * heard.velocity;
  return pose;
}

void ThreadedDevice::run(const std::stop_token& stop) noexcept
{
  VelocityEstimator velocity(driver_->limits().quantum);
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
      gone_.store(true);
      return;
    }
    if (code == IoCode::Ok)
    {
      heard.when = Clock::now();
      heard.velocity = velocity(heard.sample.position, seconds(heard.when - lastHeard));
      lastHeard = heard.when;
      heard_.publish(heard);
      spoke_.store(true);
    }
  }
  for (int i = 0; i < kLastWords; ++i)
  {
    if (driver_->tick(Eigen::Vector3d::Zero(), seconds(kPeriod), heard.sample) == IoCode::Gone)
    {
      return;
    }
  }
}

} // namespace palp
