#pragma once

#include <Eigen/Core>

namespace palp
{

/// Signed distance, near enough, to the surface of the bundled liver; negative inside.
///
/// A dome of two lobes, cut by the visceral plane, with the dents that the neighbors leave.
/// Patient frame: x to the patient's left, y to the back, z to the head; the origin lies inside,
/// the box is about 230 x 90 x 160 mm. Smooth everywhere near the surface.
///
/// @param p  [m]
/// @return   [m]
[[nodiscard]] double liverDistance(const Eigen::Vector3d& p) noexcept;

} // namespace palp
