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
    .fitted = style.fitted ? style.fitted->at(depth) : std::nullopt,
    .isLiteral = style.isLiteral };
}

} // namespace palp
