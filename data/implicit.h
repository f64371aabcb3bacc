#pragma once

#include <Eigen/Core>
#include <functional>

namespace palp
{

/// Signed distance to a surface, near enough to it [m]; negative inside, smooth near its zero.
using Distance = std::function<double(const Eigen::Vector3d&)>;

/// Outward unit normal of the level surface through a point.
[[nodiscard]] Eigen::Vector3d levelNormal(const Distance& distance, const Eigen::Vector3d& p);

/// Point on the surface, found downhill from a point near it.
/// @return  where the distance is below 1e-10 m, or the last of 20 Newton steps
[[nodiscard]] Eigen::Vector3d ontoSurface(const Distance& distance, Eigen::Vector3d p);

} // namespace palp
