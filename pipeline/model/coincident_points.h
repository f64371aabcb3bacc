#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace palp
{

/// The first of the points that coincide with each, in the single precision in which they are
/// shown, a coordinate below 2^-32 of the point's largest being 0; a point that is not finite
/// stands alone.
///
/// Found by hashing: far points or crowded places cost no more than others.
[[nodiscard]] std::vector<int> firstOfEach(std::span<const Eigen::Vector3d> points);

} // namespace palp
