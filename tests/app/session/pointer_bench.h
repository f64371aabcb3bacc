#pragma once

#include "app/session/pointer_tool.h"
#include "haptics/devices/simulated/pointer.h"
#include "haptics/servo/servo_step.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace palp::test
{

/// A camera that looks at the middle of a surface from a direction; 800 x 800 pixels, y upwards.
inline std::function<SightLine(double, double)> viewOf(
  const Surface& surface, const Eigen::Vector3d& from)
{
  Eigen::AlignedBox<double, 3> box;
  for (const Eigen::Vector3d& point : surface.points())
  {
    box.extend(point);
  }
  const double size = box.diagonal().norm();
  const Eigen::Vector3d back = from.normalized();
  const Eigen::Vector3d right = back.unitOrthogonal();
  const Eigen::Vector3d up = back.cross(right);
  const Eigen::Vector3d middle = box.center();
  const Eigen::Vector3d eye = middle + 2.0 * size * back;
  const double perPixel = 1.1 * size / 800.0;
  return [=](double x, double y)
  {
    const Eigen::Vector3d seen = middle + perPixel * ((x - 400.0) * right + (y - 400.0) * up);
    return SightLine{ .origin = eye, .direction = (seen - eye).normalized() };
  };
}

/// What a tick of the servo recorded, beside what was asked for.
struct Tick
{
  double time;  ///< [s]
  double asked; ///< depth [m]
  Sample sample;
};

/// Pointer, device, contact, law and servo step in simulated time: no screen, no thread.
class PointerBench
{
public:
  PointerBench(std::shared_ptr<const Surface> surface, const Tip& tip, const Eigen::Vector3d& from)
    : pointer(viewOf(*surface, from))
    , device_(ToolPose{ .apex = surface->points()[0] + Eigen::Vector3d(0, 0, 1.0) })
  {
    scene_.surface = surface;
    pointer.setSurfaces({ std::move(surface) });
    setTip(tip);
  }

  void setTip(const Tip& tip)
  {
    scene_.law = ForceLaw(tip, Material{ 50e3, 0.33 });
    ++scene_.version;
    device_.guided()->setScene(scene_);
  }

  /// The servo runs until a time, with the events so far.
  void runTo(double time, double tick = 1e-3)
  {
    for (; now < time; now += tick)
    {
      pointer.update(now);
      if (!ticks.empty() && now >= ledAt_ + led)
      {
        pointer.lead(ticks.back().sample);
        ledAt_ = now;
      }
      const std::optional<PressTarget> target = pointer.target();
      if (target)
      {
        device_.guided()->moveTo(*target);
      }
      const ToolPose pose = *device_.exchange(Eigen::Vector3d::Zero(), tick);
      ticks.push_back({ now, target ? target->depth : 0.0, step(scene_, pose) });
      ticks.back().sample.time = now;
    }
  }

  void run(double duration)
  {
    runTo(now + duration);
  }

  /// The largest depth beyond what was asked for [m]; a tool that is too deep may be on its way
  /// out.
  ///
  /// @param depthOf  of a sample [m]; by default what is recorded
  [[nodiscard]] double excess(const std::function<double(const Sample&)>& depthOf =
                                [](const Sample& sample) { return sample.contact.depth; }) const
  {
    double most = 0.0;
    for (std::size_t i = 1; i < ticks.size(); ++i)
    {
      const double depth = depthOf(ticks[i].sample);
      const bool isLeaving = depth < depthOf(ticks[i - 1].sample) - 1e-4;
      most = std::max(most, isLeaving ? 0.0 : depth - ticks[i].asked);
    }
    return most;
  }

  [[nodiscard]] const Sample& newest() const
  {
    return ticks.back().sample;
  }

  double now = 0.0; ///< [s]
  double led = 0.0; ///< how seldom the pointer hears of the tool [s]
  PointerTool pointer;
  std::vector<Tick> ticks;

private:
  Scene scene_;
  Pointer device_;
  double ledAt_ = 0.0; // [s]
};

} // namespace palp::test
