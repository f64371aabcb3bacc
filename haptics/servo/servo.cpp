#include "haptics/servo/servo.h"

#include "haptics/servo/realtime.h"
#include "haptics/servo/servo_step.h"

#include <Eigen/Core>
#include <optional>

namespace palp
{
namespace
{

double seconds(std::chrono::nanoseconds duration) noexcept
{
  return std::chrono::duration<double>(duration).count();
}

} // namespace

Servo::Servo(Device& device, Scene scene, const ServoOptions& options)
  : device_(device)
  , options_(options)
  , scene_(scene)
  , thread_([this](const std::stop_token& stop) { run(stop); })
{
  schedule_ =
    options.realtime ? makeRealtime(thread_.native_handle()) : "normal priority, as asked";
}

Servo::~Servo() = default; // the thread stops and joins first

void Servo::waitUntil(Clock::time_point due) noexcept
{
  std::this_thread::sleep_until(due - options_.spin);
  while (Clock::now() < due)
  {
  }
}

void Servo::run(std::stop_token stop) noexcept
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

    const std::optional<ToolPose> pose = device_.exchange(force, seconds(awake - last));
    last = awake;
    const Clock::time_point begin = Clock::now();
    Sample sample = pose ? step(scene_.read(), *pose) : Sample{};
    sample.time = seconds(awake - start);
    sample.flags |= pose ? 0U : static_cast<std::uint32_t>(Flag::DeviceLost);
    if (stopped_.load(std::memory_order_relaxed))
    {
      sample.force.setZero();
      sample.flags |= static_cast<std::uint32_t>(Flag::EmergencyStop);
    }
    force = sample.force;
    timing_.step.record(Clock::now() - begin);

    newest_.publish(sample); // for the picture, which wants the present
    history_.push(sample);   // for plots and export, which want every sample
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
