#include "haptics/servo/servo.h"

#include "haptics/error.h"
#include "haptics/servo/safety.h"
#include "haptics/servo/servo_step.h"
#include "haptics/threads/realtime.h"

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <span>
#include <unistd.h>

namespace palp
{
namespace
{

constexpr double kKept = 8.192;   // of samples [s]
constexpr double kHeadroom = 1.5; // of its mean time that an exchange may take

double seconds(std::chrono::nanoseconds duration) noexcept
{
  return std::chrono::duration<double>(duration).count();
}

std::size_t samplesIn(const ServoOptions& options)
{
  if (options.period < ServoOptions::kShortest)
  {
    throw Error(ErrorCode::BadValue, "servo: more than 4 kHz; give 1 to 4 kHz");
  }
  return options.history ? static_cast<std::size_t>(kKept / seconds(options.period)) : 1;
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
  , history_(samplesIn(options))
  , thread_([this](const std::stop_token& stop) { run(stop); })
{
  schedule_ = schedule(device.limits());
  scheduled_.count_down();
}

Servo::~Servo() = default; // the thread stops and joins first

std::string Servo::schedule(const DeviceLimits& device)
{
  number_.wait(0);
  const std::span<const std::byte> own(reinterpret_cast<const std::byte*>(this), sizeof(*this));
  std::string words = options_.realtime
    ? makeRealtime(thread_.native_handle(), number_, device.rendersForce, own)
    : "normal priority, as asked";
  if (options_.processor >= 0)
  {
    words += stayOn(thread_.native_handle(), options_.processor)
      ? "; on processor " + std::to_string(options_.processor)
      : "; processor " + std::to_string(options_.processor) + " refused";
  }
  return words;
}

void Servo::waitUntil(Clock::time_point due) noexcept
{
  sleepUntil(due - options_.spin);
  while (Clock::now() < due)
  {
  }
}

Sample Servo::computeSample(
  const Scene& scene, const std::optional<ToolPose>& pose, double elapsed) noexcept
{
  const bool stopped = stopped_.load(std::memory_order_relaxed) ||
    (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed));
  std::atomic<bool>* const fault = options_.fault;
  const bool failed = fault != nullptr && fault->load(std::memory_order_relaxed);
  const SafetyOrders orders{ .armed = scene.armed && !failed,
    .stop = stopped,
    .heartbeatAge = seconds(Clock::now() - looked_.load(std::memory_order_relaxed)) };
  if (chain_)
  {
    const ToolPose held{ .apex = held_.apex, .axis = held_.axis };
    Sample sample = step(scene, memory_, *chain_, pose, device_.status(), orders, elapsed, held);
    held_ = sample.pose;
    sample.moved = device_.status().moved;
    if (fault != nullptr && scene.armed && isFault(sample.state, sample.flags))
    {
      fault->store(true, std::memory_order_relaxed);
    }
    return sample;
  }
  held_ = pose.value_or(ToolPose{ .apex = held_.apex, .axis = held_.axis });
  Sample sample = pose ? step(scene, memory_, held_, elapsed) : Sample{};
  sample.pose = held_;
  sample.flags |= pose ? 0U : static_cast<std::uint32_t>(Flag::DeviceLost);
  sample.moved = device_.status().moved;
  sample.flags |= device_.status().clutched ? static_cast<std::uint32_t>(Flag::Clutched) : 0U;
  if (stopped)
  {
    sample.force.setZero();
    sample.flags |= static_cast<std::uint32_t>(Flag::EmergencyStop);
  }
  return sample;
}

// The force of this tick is not held back until the next one: it goes out now, or the next exchange
// begins at once. What is late is skipped on the same grid, never made up for by a burst.
Servo::Clock::time_point Servo::nextAfter(Clock::time_point due, const Wrench& wrench) noexcept
{
  using std::chrono::duration_cast;
  const auto inBus =
    duration_cast<Clock::duration>(std::chrono::duration<double>(kHeadroom * device_.busTime()));
  Clock::time_point next = due + options_.period;
  if (chain_ && inBus > Clock::duration::zero())
  {
    const Clock::time_point now = Clock::now();
    if (now + inBus > next)
    {
      const Clock::duration pace = std::max<Clock::duration>(options_.period, inBus);
      next = std::max(now, due + ServoOptions::kShortest);
      lost_ = std::max(Clock::duration::zero(), lost_ + (next - due) - pace);
      timing_.skipped.fetch_add(
        static_cast<std::uint64_t>(lost_ / pace), std::memory_order_relaxed);
      lost_ %= pace;
      return next;
    }
    device_.answer(wrench);
  }
  for (; next <= Clock::now(); next += options_.period)
  {
    timing_.skipped.fetch_add(1, std::memory_order_relaxed);
  }
  return next;
}

void Servo::run(const std::stop_token& stop) noexcept
{
  number_ = gettid();
  number_.notify_one();
  scheduled_.wait();
  const Clock::time_point start = Clock::now();
  Clock::time_point due = start;
  Clock::time_point last = start - options_.period;
  Wrench wrench;
  while (!stop.stop_requested())
  {
    waitUntil(due);
    const Clock::time_point awake = Clock::now();
    timing_.lateness.record(awake - due);

    const double elapsed = seconds(awake - last);
    const std::optional<ToolPose> pose = device_.exchange(wrench, elapsed);
    last = awake;
    if (const double delay = device_.status().delay; delay > 0.0)
    {
      timing_.poseToForce.record(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(delay)));
    }
    const Clock::time_point begin = Clock::now();
    Sample sample = computeSample(scene_.read(), pose, elapsed);
    sample.time = seconds(awake - options_.epoch.value_or(start));
    wrench = { sample.force, sample.torque };
    timing_.step.record(Clock::now() - begin);

    newest_.publish(sample); // for the picture, which wants the present
    if (options_.history)
    {
      history_.push(sample); // for plots and export, which want every sample
    }
    timing_.elapsed.store(sample.time, std::memory_order_relaxed);
    timing_.ticks.fetch_add(1, std::memory_order_relaxed);

    due = nextAfter(due, wrench);
  }
  (void)device_.exchange(Wrench{}, seconds(options_.period));
}

} // namespace palp
