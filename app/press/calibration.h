#pragma once

#include "app/input/press_options.h"
#include "calibration/tables/extent_table.h"
#include "haptics/contact/contact.h"
#include "haptics/servo/scene.h"
#include "pipeline/deform/press_of.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

/// How the surface gives way around a tool, as found by finite elements.
struct Calibration
{
  ExtentTable extents; ///< R_d(depth), for the paper's ring
  DentStyle style;     ///< of the picture
  double reach = 0.0;  ///< depth to which R_d is computed, not estimated [m]
  std::string note;    ///< what stands in for what, for the user; or empty

  // to compare with
  std::optional<FittedSurfaces> elements; ///< of a tool of this shape, scaled; none: not computed
  std::optional<double> young;            ///< E of the table's forces [Pa]; none: of another tool

  std::vector<Calibration> others{}; ///< of the scene's other organs, see organOf

  double layer = 0.0; ///< thickness that a fitted style was computed for [m]; 0: nothing is fitted

  Tip tip{}; ///< of the scene whose tissue is followed

  /// R_d at a sample, of its dent without what the body gives way as a whole: as pictures have it
  /// [m].
  [[nodiscard]] double extentRadius(const Sample& sample) const
  {
    if (style.motion != nullptr)
    {
      const auto extentAt = [this](double depth) { return extents.extentRadius(depth); };
      return pressOf(sample, tip, extentAt, style).extentRadius;
    }
    const double given = sample.localDepth > 0.0 ? sample.contact.depth - sample.localDepth : 0.0;
    const double plain = extents.extentRadius(drawnDepth(sample) - std::max(0.0, given));
    return style.extent ? style.extent(sample, plain) : plain;
  }

  [[nodiscard]] bool covers(double depth) const noexcept
  {
    return depth <= reach;
  }

  /// Whether the place is one that a fitted style was computed for: flat, level, as thick, and far
  /// from edges. Elsewhere the picture may be off by more than 3 % of the depth; so true without
  /// one.
  [[nodiscard]] bool fits(const Contact& contact) const noexcept;
};

/// The table that the options name, the paper's two spheres and cones as they are, any other sphere
/// from its dimensionless surface.
///
/// @throws Error  BadFile; BadValue: --layer or --threshold with a tool whose table has them fixed
[[nodiscard]] Calibration loadCalibration(const PressOptions& options, const ForceLaw& law);

/// The dent in each organ follows its nodules, above which R_d is another, and its friction.
void followTissue(Calibration& calibration, const Scene& scene);

/// The same of each organ of a scene, with its nodules.
[[nodiscard]] Calibration loadCalibration(const PressOptions& options, const Scene& scene);

} // namespace palp
