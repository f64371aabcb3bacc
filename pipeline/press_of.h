#pragma once

#include "haptics/servo/sample.h"
#include "pipeline/dent.h"
#include "pipeline/fitted_surfaces.h"

#include <optional>

namespace palp
{

/// The press of a sample, alike in every picture and file made of it.
///
/// @param extentRadius  R_d of the table at the sample's depth [m]
/// @param surfaces      to follow in place of the paper's ring
[[nodiscard]] inline Press pressOf(const Sample& sample, const Tip& tip, double extentRadius,
  const std::optional<FittedSurfaces>& surfaces)
{
  return { .contact = sample.contact,
    .pose = sample.pose,
    .tip = tip,
    .contactRadius = sample.response.contactRadius,
    .extentRadius = extentRadius,
    .fitted = surfaces ? surfaces->at(sample.contact.depth) : std::nullopt };
}

} // namespace palp
