#include "haptics/servo/servo.h"

#include "haptics/servo/safety.h"
#include "haptics/servo/servo_step.h"
#include "haptics/threads/realtime.h"

#include <Eigen/Core>
#include <optional>

namespace palp
{
namespace
{

constexpr std::size_t kKept = 8192; // samples, eight seconds

double seconds(std::chrono::nanoseconds duration) noexcept
{
  return std::chrono::duration<double>(duration).count();
}

// only what a hand can feel is limited: mouse and path have no motors
std::optional<SafetyChain> makeChain(const Device& device, const ServoOptions& options)
{
  if (!device.limits().rendersForce)
  {
    return std::nullopt;
  }
  return SafetyChain(
    device.limits(), { .period = seconds(options.period), .deadMan = options.deadMan });
}

} // namespace

Servo::Servo(Device& device, const Scene& scene, const ServoOptions& options)
  : device_(device)
  , options_(options)
  , scene_(scene)
  , chain_(makeChain(device, options))
  , history_(options.history ? kKept : 1)
  , thread_([this](const std::stop_token& stop) { run(stop); })
{
  schedule_ = options.realtime ? makeRealtime(thread_.native_handle(), device.limits().rendersForce)
                               : "normal priority, as asked";
}

Servo::~Servo() = default; // the thread stops and joins first

void Servo::waitUntil(Clock::time_point due) noexcept
{
  std::this_thread::sleep_until(due - options_.spin);
  while (Clock::now() < due)
  {
  }
}

Sample Servo::computeSample(
  const Scene& scene, const std::optional<ToolPose>& pose, double elapsed) noexcept
{
  const bool stopped = stopped_.load(std::memory_order_relaxed) ||
    (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed));
  const SafetyOrders orders{ .armed = scene.armed,
    .stop = stopped,
    .heartbeatAge = seconds(Clock::now() - looked_.load(std::memory_order_relaxed)) };
  if (chain_)
  {
    const ToolPose held{ .apex = held_.apex, .axis = held_.axis };
    Sample sample = step(scene, memory_, *chain_, pose, device_.status(), orders, elapsed, held);
    held_ = sample.pose;
    return sample;
  }
  held_ = pose.value_or(ToolPose{ .apex = held_.apex, .axis = held_.axis });
  Sample sample = pose ? step(scene, memory_, held_, elapsed) : Sample{};
  sample.pose = held_;
  sample.flags |= pose ? 0U : static_cast<std::uint32_t>(Flag::DeviceLost);
  if (stopped)
  {
    sample.force.setZero();
    sample.flags |= static_cast<std::uint32_t>(Flag::EmergencyStop);
  }
  return sample;
}

void Servo::run(const std::stop_token& stop) noexcept
{
  const Clock::time_point start = Clock::now();
  Clock::time_point due = start;
  Clock::time_point last = start - options_.period;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  while (!stop.stop_requested())
  {
    waitUntil(due);
    const Clock::time_point awake = Clock::now();
    timing_.lateness.record(awake - due);

    const double elapsed = seconds(awake - last);
    const std::optional<ToolPose> pose = device_.exchange(force, elapsed);
    last = awake;
    const Clock::time_point begin = Clock::now();
    Sample sample = computeSample(scene_.read(), pose, elapsed);
    sample.time = seconds(awake - start);
    force = sample.force;
    timing_.step.record(Clock::now() - begin);

    newest_.publish(sample); // for the picture, which wants the present
    if (options_.history)
    {
      history_.push(sample); // for plots and export, which want every sample
    }
    timing_.ticks.fetch_add(1, std::memory_order_relaxed);

    // what is late is skipped on the same grid, never made up for by a burst
    for (due += options_.period; due <= Clock::now(); due += options_.period)
    {
      timing_.skipped.fetch_add(1, std::memory_order_relaxed);
    }
  }
  (void)device_.exchange(Eigen::Vector3d::Zero(), seconds(options_.period));
}

} // namespace palp
