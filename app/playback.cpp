#include "app/playback.h"

#include "haptics/contact/nearest.h"
#include "haptics/servo/servo_step.h"

#include <cmath>
#include <limits>

namespace palp
{
namespace
{

constexpr double kTicksPerSecond = 1000.0;

// times of the samples: the millisecond grid from the start, and the end where the grid misses it
std::vector<double> sampleTimes(const ScriptedPath& path)
{
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

// outward normal of a point of the surface, from the normals of its triangle's corners
Eigen::Vector3d normalAt(const Surface& surface, const Nearest& nearest)
{
  const Triangle& corners = surface.triangles()[static_cast<std::size_t>(nearest.triangle)];
  const auto at = [&](int k) { return static_cast<std::size_t>(corners[static_cast<std::size_t>(k)]); };
  const Eigen::Vector3d& a = surface.points()[at(0)];
  const Eigen::Vector3d u = surface.points()[at(1)] - a;
  const Eigen::Vector3d v = surface.points()[at(2)] - a;
  const Eigen::Vector3d cross = u.cross(v);
  const Eigen::Vector3d w = nearest.point - a;
  const double area = cross.squaredNorm();
  const double second = w.cross(v).dot(cross) / area;
  const double third = u.cross(w).dot(cross) / area;
  const Eigen::Vector3d blend = (1.0 - second - third) * surface.normals()[at(0)] +
    second * surface.normals()[at(1)] + third * surface.normals()[at(2)];
  return blend.norm() > 0.0 ? blend.normalized() : cross.normalized();
}

// inward normal where the apex first touches, or comes closest
Eigen::Vector3d pressingAxis(
  const Surface& surface, const ScriptedPath& path, const std::vector<double>& times)
{
  Nearest best;
  double closest = std::numeric_limits<double>::infinity();
  for (const double time : times)
  {
    const Eigen::Vector3d apex = path.poseAt(time, -Eigen::Vector3d::UnitZ()).apex;
    const Nearest nearest = findNearest(surface, apex, std::numeric_limits<double>::infinity());
    if (nearest.triangle >= 0 && nearest.distance < closest)
    {
      best = nearest;
      closest = nearest.distance;
    }
    if (closest <= 0.0)
    {
      break;
    }
  }
  return best.triangle >= 0 ? Eigen::Vector3d(-normalAt(surface, best))
                            : Eigen::Vector3d(-Eigen::Vector3d::UnitZ());
}

} // namespace

std::vector<Sample> play(const ScriptedPath& path, const Scene& scene)
{
  const std::vector<double> times = sampleTimes(path);
  const Eigen::Vector3d axis = path.hasAxes() || !scene.surface
    ? Eigen::Vector3d(-Eigen::Vector3d::UnitZ())
    : pressingAxis(*scene.surface, path, times);
  std::vector<Sample> samples;
  samples.reserve(times.size());
  for (const double time : times)
  {
    samples.push_back(step(scene, path.poseAt(time, axis)));
    samples.back().time = time;
  }
  return samples;
}

} // namespace palp
