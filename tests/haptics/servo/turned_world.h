#pragma once

#include "haptics/servo/scene.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <Eigen/Core>
#include <memory>

namespace palp::test
{

using namespace units::literals;

inline const Eigen::Vector3d kDown = -Eigen::Vector3d::UnitZ();

inline Scene worldOf(Mesh mesh, const Tip& tip, LawMode mode)
{
  Scene scene;
  scene.surface = std::make_shared<const Surface>(makeSurface(std::move(mesh)));
  scene.law = ForceLaw(tip, makeMaterial(20.0_kPa, 0.45), { .mode = mode });
  scene.forceLimit = 1e3;
  return scene;
}

/// With its top at z = 0.
inline Mesh slab()
{
  return block({ 0.1, 0.1, 0.04 }, 30);
}

} // namespace palp::test
