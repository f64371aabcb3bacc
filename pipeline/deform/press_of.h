#pragma once

#include "haptics/servo/sample.h"
#include "pipeline/deform/dent.h"
#include "pipeline/deform/fitted_surfaces.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace palp
{

/// What the surface around a tool is drawn as.
struct DentStyle
{
  std::optional<FittedSurfaces> fitted{}; ///< to follow in place of the paper's ring
  bool isLiteral = false; ///< with the radius of Eq. (2) also where no sphere can have it

  /// R_d of a sample by that of the table [m]; empty: the same.
  std::function<double(const Sample& sample, double extent)> extent{};

  /// What the tool carries along the surface [m]; empty: nothing.
  std::function<Eigen::Vector3d(const Sample& sample)> carried{};
};

/// The depth of the surface under a tool: of tissue that relaxes also what has not yet come back.
[[nodiscard]] inline double drawnDepth(const Sample& sample) noexcept
{
  return std::max(sample.contact.depth, sample.surfaceDepth);
}

/// The sample that a picture shows in place of one whose tool has left tissue that comes back: the
/// dent is where it was left.
/// @param left  the last that touched
[[nodiscard]] inline Sample drawnSample(const Sample& sample, const Sample& left) noexcept
{
  if (sample.contact.touching() || !(sample.surfaceDepth > 0.0) || !left.contact.touching() ||
    left.organ != sample.organ)
  {
    return sample;
  }
  Sample dented = left;
  dented.surfaceDepth = sample.surfaceDepth;
  const double deeper = sample.surfaceDepth - left.contact.depth;
  dented.pose.apex -= deeper * left.contact.normal;
  dented.contact.depth = sample.surfaceDepth;
  // as wide as a ball that deep is in contact
  dented.response.contactRadius *= std::sqrt(sample.surfaceDepth / drawnDepth(left));
  return dented;
}

/// The press of a sample, alike in every picture and file made of it.
///
/// @param extentRadius  R_d of the table at the drawn depth [m]
[[nodiscard]] inline Press pressOf(
  const Sample& sample, const Tip& tip, double extentRadius, const DentStyle& style)
{
  const double depth = sample.contact.touching() ? drawnDepth(sample) : 0.0;
  const double radius = sample.response.contactRadius;
  Contact contact = sample.contact;
  ToolPose pose = sample.pose;
  pose.apex -= (depth - contact.depth) * contact.normal;
  contact.depth = depth;
  contact.normal = drawnNormal(contact.normal, sample.pose.axis, tip);
  return { .contact = contact,
    .pose = pose,
    .tip = tip,
    .contactRadius = style.isLiteral ? radius : drawnContactRadius(tip, depth, radius),
    .extentRadius = style.extent ? style.extent(sample, extentRadius) : extentRadius,
    .fitted = style.fitted ? style.fitted->at(depth) : std::nullopt,
    .carried = style.carried ? style.carried(sample) : Eigen::Vector3d(Eigen::Vector3d::Zero()),
    .isLiteral = style.isLiteral };
}

} // namespace palp
