#pragma once

#include "haptics/servo/sample.h"
#include "pipeline/deform/dent.h"
#include "pipeline/deform/fitted_surfaces.h"
#include "pipeline/motion/organ_press.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

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

  /// How the body moves as a whole; null: it stays.
  std::shared_ptr<const OrganMotion> motion{};

  /// All that presses the body, the tool of a sample first, as deep as it is drawn; not empty where
  /// it moves.
  std::function<std::vector<OrganLoad>(const Sample& sample, double depth)> loads{};
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

/// What the tool of a sample moves its body with; nothing where that stays.
[[nodiscard]] inline std::vector<OrganLoad> loadsOf(const Sample& sample, const DentStyle& style)
{
  if (style.motion == nullptr || !sample.contact.touching())
  {
    return {};
  }
  std::vector<OrganLoad> loads = style.loads(sample, drawnDepth(sample));
  loads.front() = style.motion->fitted(loads.front());
  return loads;
}

/// Turns the way that the surface goes, and puts the center of the contact to where a line that way
/// through the tool's nose meets the plane of contact: from a center beside the tool no ring could
/// be drawn about it.
/// @param normal  of drawnNormal()
inline void drawAlong(const Eigen::Vector3d& normal, const Tip& tip, Press& press)
{
  constexpr double kSteepest = 0.5; // [-] cosine from which on it goes no further away
  Contact& contact = press.contact;
  const Eigen::Vector3d nose = press.pose.apex - noseRadius(tip) * press.pose.axis;
  const double height = (contact.center - nose).dot(contact.normal);
  const double cosine = std::max(kSteepest, normal.dot(contact.normal));
  contact.center += height * (normal / cosine - contact.normal);
  contact.normal = normal;
}

/// The press of a sample, alike in every picture and file made of it.
///
/// A body that gives way as a whole moves by a wide field, as far as the tool is deep without its
/// own contact; in it is the dent of the rest.
///
/// @param extentAt  R_d of the table by the depth of the dent [m]
/// @param beside    of loadsOf, of another tool on the same body
[[nodiscard]] inline Press pressOf(const Sample& sample, const Tip& tip,
  const std::function<double(double)>& extentAt, const DentStyle& style,
  const std::vector<OrganLoad>& beside = {})
{
  const double depth = sample.contact.touching() ? drawnDepth(sample) : 0.0;
  const double radius = sample.response.contactRadius;
  Press press{ .contact = sample.contact,
    .pose = sample.pose,
    .tip = tip,
    .fitted = std::nullopt,
    .carried = style.carried ? style.carried(sample) : Eigen::Vector3d(Eigen::Vector3d::Zero()),
    .isLiteral = style.isLiteral };
  press.pose.apex -= (depth - sample.contact.depth) * sample.contact.normal;
  press.contact.depth = depth;
  press.motion = style.motion;
  press.loads = loadsOf(sample, style);
  press.loads.insert(press.loads.end(), beside.begin(), beside.end());
  if (style.motion != nullptr && depth > 0.0)
  {
    seeFromBody(*style.motion, press.loads, tip, press.contact, press.pose);
  }
  const double drawn = press.contact.depth;
  drawAlong(drawnNormal(sample.contact.normal, press.pose.axis, tip), tip, press);
  press.contactRadius = style.isLiteral ? radius : drawnContactRadius(tip, drawn, radius);
  const double extent = style.extent ? style.extent(sample, extentAt(drawn)) : extentAt(drawn);
  // a dent that nowhere sinks as far as R_d says still reaches as far as the tool
  press.extentRadius = extent > 0.0 ? std::max(extent, press.contactRadius) : extent;
  press.fitted = style.fitted ? style.fitted->at(drawn) : std::nullopt;
  return press;
}

/// The same.
/// @param extentRadius  at the drawn depth [m]
[[nodiscard]] inline Press pressOf(
  const Sample& sample, const Tip& tip, double extentRadius, const DentStyle& style)
{
  return pressOf(
    sample, tip, [extentRadius](double) { return extentRadius; }, style);
}

} // namespace palp
