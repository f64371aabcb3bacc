#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

namespace palp
{

/// Where a body is held, and which way.
struct HeldWay
{
  Eigen::Vector3d place; ///< [m]
  Eigen::Vector3d way;   ///< unit; 0: none
};

/// The motions that are left free, for people: "move along x and turn about z"; empty: none.
/// @param size  of the body [m]
[[nodiscard]] std::string freeMotionOf(std::span<const HeldWay> held, double size);

} // namespace palp
