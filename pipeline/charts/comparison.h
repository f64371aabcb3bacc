#pragma once

#include "calibration/tables/extent_table.h"
#include "haptics/force/force_law.h"
#include "haptics/force/nodules/nodule_field.h"
#include "pipeline/charts/plot.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "pipeline/model/reference_curve.h"

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palp
{

/// A law to compare.
struct NamedLaw
{
  std::string name;
  ForceLaw law;
  ContactGeometry
    geometry{}; ///< what the law knows but the depth; by default a half-space pressed straight
  std::optional<std::size_t>
    color{}; ///< as curveColor, which then is no reference's; none: the next
  std::function<double(double)> answer{}; ///< force [N] at a depth [m] of more than the law; or not

  [[nodiscard]] double force(double depth) const
  {
    if (answer)
    {
      return answer(depth);
    }
    ContactGeometry at = geometry;
    at.depth = depth;
    return law(at).force;
  }
};

/// Forces over the depth: the laws, the 7 % band of the first of them, and references.
///
/// @param laws        at least one
/// @param deepest     end of the axis [m]
/// @param references  depth [m] and force [N]
/// @source Sec. 4.3: 7 % of the largest force is what a hand just notices
[[nodiscard]] std::unique_ptr<Plot> forcePlot(
  const std::vector<NamedLaw>& laws, double deepest, const std::vector<ReferenceCurve>& references);

/// Difference of the references from the first law, in per cent of the largest reference force; in
/// the colors of forcePlot().
/// @source Eq. (9)
[[nodiscard]] std::unique_ptr<Plot> forceErrorPlot(
  const std::vector<NamedLaw>& laws, double deepest, const std::vector<ReferenceCurve>& references);

/// R_d over the depth: the table's rows and line, the quadratic fit of Fig. 8, and references.
///
/// @param references  depth [m] and R_d [m]
[[nodiscard]] std::unique_ptr<Plot> extentPlot(
  const ExtentTable& table, const std::vector<ReferenceCurve>& references);

/// A cut through the contact along its normal: tool, surface at rest and as drawn, the Bezier curve
/// of Eq. (8) with its control points, and the surface of finite elements.
///
/// @param press     up to date, pressed, with its patch
/// @param towards   direction of the cut, not along the normal; the edge between two Bezier patches
///                  that is nearest to it
/// @param elements  of the same tool and depth on a plane, if they are known; drawn below the
///                  surface at rest
/// @param nodules   in the body; drawn where the cut meets them, as they lie at rest
/// @source          Fig. 5
[[nodiscard]] std::unique_ptr<Plot> sectionPlot(vtkPalpDeformFilter& press,
  const Eigen::Vector3d& towards, const std::optional<SurfaceProfile>& elements = std::nullopt,
  std::span<const PlacedNodule> nodules = {});

} // namespace palp
