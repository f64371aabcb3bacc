#pragma once

#include "calibration/organ/organ_model.h"
#include "haptics/surface/surface.h"
#include "haptics/surface/surface_point.h"

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace palp
{

class MappedContact;

/// What a body adds to the displacement of its own surface at a place, beyond a half-space:
/// G_reg(p + x, p + y) = G0 + b.(x + y) + (x'Ax + y'Ay) / 2, for a load at p + x, read at p + y.
struct OrganCompliance
{
  double constant = 0.0;                           ///< G0 [m/N]; negative over a near support
  Eigen::Vector3d slope = Eigen::Vector3d::Zero(); ///< b, in the tangent plane [1/N]
  double bend = 0.0;                               ///< tr A [1/(m N)]
  bool isAtBorder = false;                         ///< between two moduli, which it tells less of
};

/// Reads it around smooth pressures of a radius of one and a half cells, all of them at once.
///
/// The field of a half-space under this is known; the cubes have to give only what the body does
/// otherwise, where its surface is not flat and where it is held.
///
/// @param mapped  of the model, takes a while to make; null: it is even
/// @param places  with outward unit normals
/// @return        of each; none where less than half of a ring is on the body, or the body hangs
///                over it
[[nodiscard]] std::vector<std::optional<OrganCompliance>> compliancesAt(const OrganModel& model,
  const Surface& surface, const MappedContact* mapped, std::span<const SurfacePoint> places);

/// Radius of those pressures [m].
[[nodiscard]] constexpr double pressedRadius(double side) noexcept
{
  constexpr double kSides = 1.5;
  return kSides * side;
}

/// The same of one.
[[nodiscard]] std::optional<OrganCompliance> complianceAt(const OrganModel& model,
  const Surface& surface, const Eigen::Vector3d& place, const Eigen::Vector3d& outward);

/// Radius of the pressure under which the motion of a whole body is drawn, wide against a contact,
/// whose dent is drawn by itself [m].
[[nodiscard]] constexpr double drawnRadius(double side) noexcept
{
  constexpr double kWide = 7.5; // sides: five times the radius of the pressure that is solved for
  return kWide * side;
}

/// How a surface moves under a newton at each of some places, inwards along its normal: of the body
/// as a whole, by the field of a half-space under the pressure that is solved for less the same
/// under one of drawnRadius.
///
/// @param loads   with outward unit normals; one that the body hangs over moves nothing
/// @param places  where the motion is read, likewise
/// @return        x, y, z of place after place, a column for each load [m/N]
[[nodiscard]] Eigen::MatrixXd motionsBy(const OrganModel& model, const Surface& surface,
  std::span<const SurfacePoint> loads, std::span<const SurfacePoint> places);

} // namespace palp
