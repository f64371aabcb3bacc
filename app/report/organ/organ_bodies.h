#pragma once

#include "app/report/references.h"
#include "calibration/organ/organ_model.h"
#include "haptics/surface/surface.h"
#include "haptics/surface/surface_point.h"

#include <memory>
#include <string>
#include <vector>

namespace palp::report
{

/// The ball that presses all of them [m].
inline constexpr double kOrganBall = 10e-3;

/// A place of a body, and the forces there as an independent program has them.
struct OrganPress
{
  std::string name;
  SurfacePoint place;
  ReferenceForces reference{}; ///< from 1 mm of depth on, which its elements resolve
};

/// A body that gives way as a whole.
struct OrganBody
{
  std::string kind; ///< layers, edges, lobes, domes or liver
  std::string name;
  double poisson = 0.45; ///< [-]
  std::shared_ptr<const Surface> surface;
  Support support;
  std::vector<OrganPress> presses{};
};

/// Layers, wedges, lobes along and across the grid of the cells, domes and the bundled liver.
/// @param quick   one of each kind
/// @throws Error  BadFile: a table of reference or the liver is missing
[[nodiscard]] std::vector<OrganBody> organBodies(bool quick);

} // namespace palp::report
