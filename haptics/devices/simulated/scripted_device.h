#pragma once

#include "haptics/devices/device.h"
#include "haptics/devices/simulated/playhead.h"
#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/threads/latest.h"

#include <atomic>

namespace palp
{

/// Plays a path in the time of its caller; no force can move it.
///
/// Where it is sent to another place of the path, or begins anew there, the tool is taken off the
/// tissue first: the playing waits while the tool stands above the new place, for longer than a
/// bounce of 20 ms, so that a press ends, and tissue that relaxes or rubs is not dragged along. To
/// a place next to the last one it goes directly.
class ScriptedDevice final : public Device
{
public:
  static constexpr double kLift = 0.1;       ///< along the axis, of a tool taken elsewhere [m]
  static constexpr double kLiftTime = 0.025; ///< [s]
  static constexpr double kNext = 1e-3;      ///< from the last place to one next to it, at most [m]

  /// @param path         starts to play at the first exchange
  /// @param missingAxis  unit vector that stands in where the path gives no axis
  explicit ScriptedDevice(
    ScriptedPath path, const Eigen::Vector3d& missingAxis = -Eigen::Vector3d::UnitZ());

  /// Main thread only.
  void play(const PlayOrder& order)
  {
    order_.publish(order);
  }

  /// Where on the path the last exchange was, from its beginning [s]. Any thread.
  [[nodiscard]] double reached() const noexcept
  {
    return reached_.load(std::memory_order_relaxed);
  }

  [[nodiscard]] double duration() const noexcept
  {
    return path_.duration();
  }

  [[nodiscard]] DeviceLimits limits() const override;

  /// The velocity is that of the tool, as fast as it is played; zero where it pauses.
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench& wrench, double dt) noexcept override;

private:
  ScriptedPath path_;
  Eigen::Vector3d missingAxis_;
  Latest<PlayOrder> order_;
  std::atomic<double> reached_ = 0.0;
  static_assert(std::atomic<double>::is_always_lock_free);

  // of the thread that exchanges
  Playhead head_;
  Eigen::Vector3d last_; // apex on the path [m]
  double lifted_ = 0.0;  // for so long yet [s]
};

} // namespace palp
