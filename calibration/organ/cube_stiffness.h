#pragma once

#include <Eigen/Core>
#include <bitset>
#include <cstddef>

namespace palp
{

using CubeStiffness = Eigen::Matrix<double, 24, 24>; ///< [N/m], x, y and z of corner after corner

/// Corner of a cube: bit 0 of its number is x, bit 1 y, bit 2 z.
constexpr int kCubeCorners = 8;

constexpr int kCubeParts = 4; ///< points along a side of a cube at which it is known what is inside

/// Which of these points are inside, x fastest, then y and z.
using CubePoints = std::bitset<std::size_t{ kCubeParts } * kCubeParts * kCubeParts>;

/// Stiffness of a cube of eight nodes whose dilatation is the mean of the cube, so that it does not
/// lock where nu comes near 1/2.
///
/// @param side           [m]
/// @param youngModulus   [Pa]
/// @param poissonRatio   0 to below 0.5 [-]
/// @source               Hughes, "Generalization of selective integration procedures", 1980 (B-bar)
[[nodiscard]] CubeStiffness cubeStiffness(double side, double youngModulus, double poissonRatio);

/// The same of the part of a cube around the points that are inside: finite cells.
///
/// @param inside  at least one
/// @source        Parvizian, Duester and Rank, Computational Mechanics 41, 2007
[[nodiscard]] CubeStiffness cutCubeStiffness(
  double side, double youngModulus, double poissonRatio, const CubePoints& inside);

} // namespace palp
