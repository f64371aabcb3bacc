#pragma once

#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <memory>
#include <utility>

namespace palp::test
{

using namespace units::literals;
using Eigen::Vector3d;
using Shared = std::shared_ptr<const Surface>;

inline constexpr double kAllowed = 0.1_mm; ///< deeper than asked for [m]
inline const Vector3d kAbove(0.02, 0.01, 1.0);

inline Shared shared(Mesh mesh)
{
  return std::make_shared<const Surface>(makeSurface(std::move(mesh)));
}

inline Shared block()
{
  return shared(block(Vector3d(100.0_mm, 100.0_mm, 30.0_mm), 20));
}

} // namespace palp::test
