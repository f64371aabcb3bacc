#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/maps/stiffness_field.h"
#include "haptics/surface/surface.h"

#include <functional>
#include <memory>

namespace palp
{

/// Young's modulus at a point of a body [Pa], above 0, in the frame of its surface [m]; not a
/// number where it is not known. Called by several threads at once.
using ModulusAt = std::function<double(const Eigen::Vector3d&)>;

/// A place below a curved surface that is taken for one below a flat one: x, y, z down [m].
/// @param curvature  mean, convex positive [1/m]
[[nodiscard]] Eigen::Vector3d belowCurved(const Eigen::Vector3d& flat, double curvature) noexcept;

/// The stiffness of a body that varies from place to place, felt by the tool of a law, whose own
/// modulus then says nothing. Takes some seconds.
///
/// @param modulus  empty: of no body that varies
/// @return         null where it is empty
/// @throws Error   BadValue: it is not known where the tool would feel it, or not above 0; another
///                 law than the corrected one, coatings, or a memory
[[nodiscard]] std::shared_ptr<const StiffnessField> embedStiffness(
  const Surface& surface, const ForceLaw& law, const ModulusAt& modulus);

/// The same under one tool on a flat body: of a modulus in the tool's frame, z below the surface.
/// @param place    its depth does not count
/// @param deepest  [m]
/// @throws Error   as the other
[[nodiscard]] std::shared_ptr<const StiffnessField> stiffnessUnder(
  const ForceLaw& law, const ContactGeometry& place, double deepest, const ModulusAt& modulus);

/// A contact as it is felt there.
[[nodiscard]] inline StiffnessContact stiffnessContactOf(const Contact& contact) noexcept
{
  return { .center = contact.center,
    .normal = contact.normal,
    .depth = contact.depth,
    .turning = contact.turning };
}

} // namespace palp
