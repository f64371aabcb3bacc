#include "app/press/playback.h"

#include "haptics/devices/hid/paper_arm.h"
#include "haptics/error.h"
#include "haptics/servo/safety.h"
#include "haptics/servo/servo_step.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/surface_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

constexpr double kTicksPerSecond = 1000.0;
constexpr double kLongest = 3600.0; // [s]

// times of the samples: the millisecond grid from the start, and the end where the grid misses it
std::vector<double> sampleTimes(const ScriptedPath& path)
{
  if (path.duration() > kLongest)
  {
    throw Error(ErrorCode::BadValue,
      "path: it lasts longer than an hour, which is the most, since a sample is kept for each "
      "millisecond; cut it, or check that its times are seconds");
  }
  const double ticks = path.duration() * kTicksPerSecond;
  const double whole = std::floor(ticks + 1e-6);
  std::vector<double> times;
  for (double k = 0.0; k <= whole; ++k)
  {
    times.push_back(path.startTime() + k / kTicksPerSecond);
  }
  if (ticks - whole > 1e-6)
  {
    times.push_back(path.startTime() + path.duration());
  }
  return times;
}

// inward normal where the apex first touches an organ, or comes closest to one
Eigen::Vector3d pressingAxis(
  const Scene& scene, const ScriptedPath& path, const std::vector<double>& times)
{
  const Surface* surface = nullptr;
  ClosestPoint best;
  double closest = std::numeric_limits<double>::infinity();
  for (const double time : times)
  {
    const Eigen::Vector3d apex = path.poseAt(time, -Eigen::Vector3d::UnitZ()).apex;
    for (int i = 0; i < organCount(scene); ++i)
    {
      const Surface& organ = *organOf(scene, i).surface;
      const ClosestPoint nearest =
        findClosestPoint(organ, apex, std::numeric_limits<double>::infinity());
      if (nearest.triangle >= 0 && nearest.distance < closest)
      {
        surface = &organ;
        best = nearest;
        closest = nearest.distance;
      }
    }
    if (closest <= 0.0)
    {
      break;
    }
  }
  return surface != nullptr
    ? Eigen::Vector3d(-surfacePoint(*surface, best.triangle, best.point).normal)
    : Eigen::Vector3d(-Eigen::Vector3d::UnitZ());
}

} // namespace

std::vector<Sample> play(const ScriptedPath& path, const Scene& scene, bool chained)
{
  const std::vector<double> times = sampleTimes(path);
  const Eigen::Vector3d axis = path.hasAxes() || !scene.surface
    ? Eigen::Vector3d(-Eigen::Vector3d::UnitZ())
    : pressingAxis(scene, path, times);
  std::vector<Sample> samples;
  samples.reserve(times.size());
  SafetyChain chain(paperArm());
  TissueMemory memory;
  double last = times.front() - 1.0 / kTicksPerSecond;
  for (const double time : times)
  {
    const ToolPose pose = path.poseAt(time, axis);
    const double dt = time - last;
    samples.push_back(chained ? step(scene, memory, chain, pose, {}, { .armed = true }, dt)
                              : step(scene, memory, pose, dt));
    samples.back().time = time;
    last = time;
  }
  return samples;
}

bool isFinerThanSamples(const ScriptedPath& path)
{
  constexpr double kNoLess = 0.8 / kTicksPerSecond; // a device's milliseconds vary
  constexpr double kAppears = 3e-6;                 // in what recordings leave out, see parsePath
  const auto isFine = [](const PathKnot& one, const PathKnot& next)
  { return next.time - one.time < kNoLess && next.time - one.time > kAppears; };
  return std::ranges::adjacent_find(path.knots(), isFine) != path.knots().end();
}

std::vector<Sample> playEach(const std::vector<ScriptedPath>& paths, const Scene& scene,
  bool chained, const std::function<void(std::span<const Sample>)>& played)
{
  constexpr double kPause = 100.0; // ticks
  double start = 0.0;              // of a path, in ticks
  std::vector<Sample> all;
  for (const ScriptedPath& path : paths)
  {
    std::vector<Sample> samples = play(path, scene, chained);
    played ? played(samples) : void();
    for (Sample& sample : samples)
    {
      // on the grid of milliseconds, so that no sum of two times rounds off it
      const double ticks = (sample.time - path.startTime()) * kTicksPerSecond;
      const double whole = std::round(ticks);
      sample.time = (start + (std::abs(ticks - whole) < 1e-6 ? whole : ticks)) / kTicksPerSecond;
      all.push_back(std::move(sample));
    }
    start += std::ceil(path.duration() * kTicksPerSecond) + kPause;
  }
  return all;
}

} // namespace palp
