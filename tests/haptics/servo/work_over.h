#pragma once

#include "haptics/servo/servo_step.h"

#include <functional>

namespace palp::test
{

/// Work of the hand over a way of poses, that at 0 to that at 1 [J].
inline double workOver(const Scene& world, int steps, const std::function<ToolPose(double)>& path)
{
  double work = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    const Eigen::Vector3d move =
      path((i + 1.0) / steps).apex - path(static_cast<double>(i) / steps).apex;
    work -= step(world, path((i + 0.5) / steps)).force.dot(move);
  }
  return work;
}

} // namespace palp::test
