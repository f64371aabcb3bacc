#pragma once

#include "tests/pipeline/surfaces.h"

#include <algorithm>

namespace palp::test
{

inline constexpr double kInside = 1e-6; ///< [m] allowed depth inside the tool

inline const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/// Of the points that moved, the deepest in the tool [m].
inline double deepestInside(const DentedSurface& surface, const Press& press)
{
  const ToolBody body(press.tip, press.pose);
  double deepest = -1.0;
  for (std::size_t i = 0; i < surface.count(); ++i)
  {
    if (surface.zone[i] != 0)
    {
      deepest = std::max(deepest, body.inside(DentedSurface::at(surface.points, i)));
    }
  }
  return deepest;
}

} // namespace palp::test
