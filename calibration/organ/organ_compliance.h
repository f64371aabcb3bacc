#pragma once

#include "calibration/organ/organ_model.h"
#include "haptics/surface/surface.h"
#include "haptics/surface/surface_point.h"

#include <optional>
#include <span>
#include <vector>

namespace palp
{

/// What a body adds to the displacement of its own surface at a place, beyond a half-space:
/// G_reg(p + x, p + y) = G0 + b.(x + y) + (x'Ax + y'Ay) / 2, for a load at p + x, read at p + y.
struct OrganCompliance
{
  double constant = 0.0;                           ///< G0 [m/N]; negative over a near support
  Eigen::Vector3d slope = Eigen::Vector3d::Zero(); ///< b, in the tangent plane [1/N]
  double bend = 0.0;                               ///< tr A [1/(m N)]
};

/// Reads it around smooth pressures of a radius of one and a half cells, all of them at once.
///
/// The field of a half-space under this is known; the cubes have to give only what the body does
/// otherwise, where its surface is not flat and where it is held.
///
/// @param places  with outward unit normals
/// @return        of each; none where less than half of a ring is on the body, or the body hangs
///                over it
[[nodiscard]] std::vector<std::optional<OrganCompliance>> compliancesAt(
  const OrganModel& model, const Surface& surface, std::span<const SurfacePoint> places);

/// The same of one.
[[nodiscard]] std::optional<OrganCompliance> complianceAt(const OrganModel& model,
  const Surface& surface, const Eigen::Vector3d& place, const Eigen::Vector3d& outward);

} // namespace palp
