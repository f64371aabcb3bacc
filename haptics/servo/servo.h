#pragma once

#include "haptics/devices/device.h"
#include "haptics/servo/safety.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"
#include "haptics/servo/timing.h"
#include "haptics/servo/tissue_memory.h"
#include "haptics/threads/latest.h"
#include "haptics/threads/ring.h"

#include <atomic>
#include <chrono>
#include <latch>
#include <optional>
#include <string>
#include <sys/types.h>
#include <thread>

namespace palp
{

/// How the servo thread is to run.
struct ServoOptions
{
  static constexpr std::chrono::microseconds kShortest{ 250 };

  std::chrono::nanoseconds period = std::chrono::milliseconds(1); ///< kShortest or more
  std::chrono::nanoseconds spin{ 0 }; ///< before each deadline, awake: costs CPU, saves lateness
  bool realtime = true;               ///< ask for SCHED_FIFO and locked memory
  int processor = -1;                 ///< to stay on; below 0: any
  bool history = true;                ///< keep every sample for plots and export
  bool deadMan = false;               ///< force only while the device's first button is held
  const std::atomic<bool>* stop = nullptr; ///< an emergency stop that outlives servos, for signals
  /// Of two hands: set by a fault of either while it is armed, disarms both until cleared; outlives
  /// servos.
  std::atomic<bool>* fault = nullptr;
  /// From which on times are told; none: from the first tick.
  std::optional<std::chrono::steady_clock::time_point> epoch{};
};

/// The loop that a hand feels: device, contact, law, limits, device, at a fixed rate.
///
/// A device that renders force does so through the safety chain, and only while the scene is armed.
///
/// Pose, law and force are one exchange of this thread: no force waits for the next tick. Where a
/// bus leaves time for it, a force goes out by itself before the thread sleeps; where not, the next
/// exchange begins at once, and the bus sets the pace.
///
/// One thread of its own, three exchanges with the main thread: the scene in, the newest sample
/// and all samples out. A deadline that is missed is counted and skipped, never made up for. The
/// last force sent is zero.
class Servo
{
  using Clock = std::chrono::steady_clock;

public:
  /// Starts the thread.
  /// @param device  outlives this object, and is used by its thread alone
  Servo(Device& device, const Scene& scene, const ServoOptions& options = {});

  /// Stops the thread, with zero force.
  ~Servo();

  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;

  /// Main thread only.
  void setScene(Scene scene)
  {
    scene_.publish(std::move(scene));
  }

  /// For the picture. Main thread only; the reference stays valid until the next call.
  ///
  /// Whoever renders force must look ten times a second: the force of a main thread that is silent
  /// fades, and after two seconds its silence is an emergency stop.
  [[nodiscard]] const Sample& newest() noexcept
  {
    looked_.store(Clock::now(), std::memory_order_relaxed);
    return newest_.read();
  }

  /// For plots and export, which want every sample; main thread only. Holds eight seconds, or
  /// nothing where the options ask for no history.
  [[nodiscard]] Ring<Sample>& history() noexcept
  {
    return history_;
  }

  /// Zero force from the next tick on, until released. Any thread, signal handlers included.
  void setEmergencyStop(bool stop) noexcept
  {
    stopped_.store(stop);
  }

  [[nodiscard]] const Timing& timing() const noexcept
  {
    return timing_;
  }

  /// In plain words, whether the system grants real-time priority, and what to change if not.
  [[nodiscard]] const std::string& schedule() const noexcept
  {
    return schedule_;
  }

private:
  void run(const std::stop_token& stop) noexcept;
  [[nodiscard]] Sample computeSample(
    const Scene& scene, const std::optional<ToolPose>& pose, double elapsed) noexcept;
  void waitUntil(Clock::time_point due) noexcept;
  [[nodiscard]] Clock::time_point nextAfter(Clock::time_point due, const Wrench& wrench) noexcept;
  [[nodiscard]] std::string schedule(const DeviceLimits& device);

  Device& device_;
  ServoOptions options_;
  Latest<Scene> scene_;
  std::optional<SafetyChain> chain_; // where a hand can feel the force
  TissueMemory memory_;              // where the tissue relaxes or rubs
  ToolPose held_;                    // where the tool was last, for a device that is gone
  Latest<Sample> newest_;
  Ring<Sample> history_;
  std::atomic<bool> stopped_ = false;
  std::atomic<Clock::time_point> looked_ = Clock::now(); // when the main thread was last seen
  Timing timing_;
  Clock::duration lost_{}; // of the bus, less than a period
  std::string schedule_;
  std::atomic<pid_t> number_ = 0; // of the thread in the kernel
  std::latch scheduled_{ 1 }; // locking memory holds up every thread: the first tick is after it
  std::jthread thread_;       // last: it uses all the others
};

} // namespace palp
