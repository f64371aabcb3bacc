#pragma once

#include "calibration/extent_table.h"
#include "data/shapes.h"
#include "haptics/servo/scene.h"
#include "pipeline/dent.h"
#include "pipeline/fitted_surfaces.h"

#include <optional>

namespace palp::report
{

/// What the paper times as one step, as this program does it: contact, force, dented surface and
/// its normals, for a tool pressed straight into a plane of n x n points, 100 mm wide.
/// @source  Sec. 4.2, Table 1
class OurStep
{
public:
  /// @param fitted  surfaces of finite elements in place of the paper's ring
  OurStep(int n, const Tip& tip, ExtentTable extents, std::optional<FittedSurfaces> fitted = {});

  /// @param apex  of the tool [m]
  void operator()(const Eigen::Vector3d& apex);

  [[nodiscard]] std::size_t vertices() const noexcept
  {
    return zone_.size();
  }

  /// Where a vertex is after the last step [m].
  [[nodiscard]] Eigen::Vector3d vertex(std::size_t i) const noexcept
  {
    return Eigen::Map<const Eigen::Vector3f>(points_.data() + 3 * i).cast<double>();
  }

private:
  [[nodiscard]] DentArrays arrays() noexcept
  {
    return { points_.data(), normals_.data(), displacement_.data(), zone_.data() };
  }

  Scene scene_;
  ExtentTable extents_;
  std::optional<FittedSurfaces> fitted_;
  std::vector<float> rest_;
  std::vector<float> points_;
  std::vector<float> normals_;
  std::vector<float> displacement_;
  std::vector<unsigned char> zone_;
  Dent dent_;
};

} // namespace palp::report
