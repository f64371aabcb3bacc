#pragma once

#include "calibration/organ/organ_model.h"
#include "haptics/surface/surface.h"

#include <optional>

namespace palp
{

/// What a body adds to the displacement of its own surface at a place, beyond a half-space:
/// G_reg(p + x, p + y) = G0 + b.(x + y), for a load at p + x that is read at p + y.
struct OrganCompliance
{
  double constant = 0.0;                           ///< G0 [m/N]; negative over a near support
  Eigen::Vector3d slope = Eigen::Vector3d::Zero(); ///< b, in the tangent plane [1/N]
};

/// Reads it around a load of Hertz's pressure of a radius of two cells.
///
/// The displacement of a half-space by the same pressure is taken off rings of 1 to 1.6 radii, so
/// that what the grid itself adds below the load does not count.
///
/// @param place    on the surface [m]
/// @param outward  unit normal there
/// @return         none where less than half of a ring is on the body
[[nodiscard]] std::optional<OrganCompliance> complianceAt(const OrganModel& model,
  const Surface& surface, const Eigen::Vector3d& place, const Eigen::Vector3d& outward);

/// Normal displacement of the surface of a half-space by Hertz's pressure of a unit force.
///
/// @param distance  from its middle [m]
/// @param radius    of the pressure [m]
/// @param modulus   E* [Pa]
/// @return          [m/N]
/// @source          Johnson, Contact Mechanics, 1985, Eq. (3.42)
[[nodiscard]] double hertzDisplacement(double distance, double radius, double modulus) noexcept;

} // namespace palp
