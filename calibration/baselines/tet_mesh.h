#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace palp::fem
{

/// A soft body of tetrahedra, for the baselines that are stepped in time.
struct TetMesh
{
  Eigen::Matrix3Xd positions{};                ///< undeformed, +z out of the body [m]
  std::vector<std::array<int, 4>> tets{};      ///< of either orientation
  std::vector<std::array<int, 3>> triangles{}; ///< of the surface that the tool may touch
  std::vector<int> surface{};                  ///< the nodes of these triangles
  std::vector<int> bonded{};                   ///< nodes held in place
};

/// A block whose top lies in z = 0, centered, facing +z; its bottom is bonded.
///
/// The top has n^2 nodes, (3 n - 1)(n - 1) edges and 2 (n - 1)^2 triangles, as the paper's surfaces
/// have. Every cell becomes six tetrahedra, neighbors being mirror images. Layers are as thick as
/// the nodes are apart at the top and grow downwards, where the strains are small.
///
/// @param width   of the square top [m]
/// @param height  [m]
/// @param n       nodes along each side, 2 or more; 40 for the paper's 1,600
/// @param layers  nodes along the height, 2 or more
/// @throws Error  BadValue: a size or number out of range
/// @source        cells: Kuhn 1960, mirrored (Todd's J1), so that no direction is preferred
[[nodiscard]] TetMesh blockTets(double width, double height, int n, int layers);

/// From the first node of a tetrahedron to the others, in columns [m].
[[nodiscard]] Eigen::Matrix3d edgesOf(
  const Eigen::Matrix3Xd& positions, const std::array<int, 4>& tet);

/// Volume of a tetrahedron [m^3].
[[nodiscard]] double volume(const Eigen::Matrix3Xd& positions, const std::array<int, 4>& tet);

/// How many tetrahedra are turned inside out at these positions of the nodes.
[[nodiscard]] int invertedElements(const TetMesh& mesh, const Eigen::Matrix3Xd& positions);

/// @throws Error  BadMesh: no element, no surface, nothing bonded, an index out of range, a node of
///                no element, a coordinate that is no number, or a sliver: an element whose volume
///                is below 1/1000 of that of the regular one with the same edges in the mean
void check(const TetMesh& mesh);

} // namespace palp::fem
