#pragma once

#include "calibration/organ/organ_model.h"
#include "haptics/surface/surface.h"

#include <optional>

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

/// Reads it around a smooth pressure of a radius of one and a half cells.
///
/// The field of a half-space under this is known; the cubes have to give only what the body does
/// otherwise, where its surface is not flat and where it is held.
///
/// @param place    on the surface [m]
/// @param outward  unit normal there
/// @return         none where less than half of a ring is on the body, or the body hangs over it
[[nodiscard]] std::optional<OrganCompliance> complianceAt(const OrganModel& model,
  const Surface& surface, const Eigen::Vector3d& place, const Eigen::Vector3d& outward);

} // namespace palp
