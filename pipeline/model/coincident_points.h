#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace palp
{

/// The first of the points that coincide with each, in the single precision in which they are
/// shown; a point that is not finite stands alone.
///
/// Found by sorting: far points or crowded places cost no more than others.
[[nodiscard]] std::vector<int> firstOfEach(std::span<const Eigen::Vector3d> points);

} // namespace palp
