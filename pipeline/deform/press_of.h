#pragma once

#include "haptics/servo/sample.h"
#include "pipeline/deform/dent.h"
#include "pipeline/deform/fitted_surfaces.h"

#include <optional>

namespace palp
{

/// What the surface around a tool is drawn as.
struct DentStyle
{
  std::optional<FittedSurfaces> fitted{}; ///< to follow in place of the paper's ring
  bool isLiteral = false; ///< with the radius of Eq. (2) also where no sphere can have it
};

/// The way that a surface goes below a tool: against the contact's normal, unless a straight flank
/// or the shaft of a tool that leans would stand along it as a wall; then as near to it as leaves
/// 12 degrees between them.
///
/// @param normal  unit
/// @param axis    of the tool, unit
/// @return        unit, in the plane of both
[[nodiscard]] Eigen::Vector3d drawnNormal(
  const Eigen::Vector3d& normal, const Eigen::Vector3d& axis, const Tip& tip) noexcept;

/// The press of a sample, alike in every picture and file made of it.
///
/// @param extentRadius  R_d of the table at the sample's depth [m]
[[nodiscard]] inline Press pressOf(
  const Sample& sample, const Tip& tip, double extentRadius, const DentStyle& style)
{
  const double depth = sample.contact.depth;
  const double radius = sample.response.contactRadius;
  Contact contact = sample.contact;
  contact.normal = drawnNormal(contact.normal, sample.pose.axis, tip);
  return { .contact = contact,
    .pose = sample.pose,
    .tip = tip,
    .contactRadius = style.isLiteral ? radius : drawnContactRadius(tip, depth, radius),
    .extentRadius = extentRadius,
    .fitted = style.fitted ? style.fitted->at(depth) : std::nullopt };
}

} // namespace palp
