#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace palp
{

/// What the triangles below one node of a BoxTree add up to, about an origin of their own.
///
/// Integrals over them of polynomials in the place x from there, and of those times the outward
/// normal n or the height d = n x of their planes.
struct FacetSum
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();        ///< [m]
  double area = 0.0;                                       ///< [m^2]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();         ///< of x [m^3]
  double squares = 0.0;                                    ///< of |x|^2 [m^4]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();        ///< of n [m^2]
  Eigen::Matrix3d normalPlace = Eigen::Matrix3d::Zero();   ///< of n x^T [m^3]
  Eigen::Vector3d normalSquares = Eigen::Vector3d::Zero(); ///< of n |x|^2 [m^4]
  double height = 0.0;                                     ///< of d [m^3]
  Eigen::Vector3d heightPlace = Eigen::Vector3d::Zero();   ///< of d x [m^4]
  double heightSquares = 0.0;                              ///< of d |x|^2 [m^5]

  Eigen::Vector3d axis = Eigen::Vector3d::Zero(); ///< about which all normals are; unit length
  double cosine = 1.0;                            ///< of the widest from it
  double sine = 0.0;                              ///< of the same
  double low = 0.0;                               ///< of the corners along the axis [m]
  double high = 0.0;                              ///< of the same [m]

  /// Whether a place is in front of each triangle (side above 0), or behind each (below 0).
  /// False, too, where that is not sure.
  /// @param center  the place [m]
  /// @param reach   of its distance from any of them [m]
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] bool areAllSeen(
    const Eigen::Vector3d& center, double reach, double side) const noexcept;
};

/// The sums of those nodes of a BoxTree for which that pays, so that a search need not visit each
/// triangle of what is wholly within its reach. A tenth of a kilobyte for each triangle, at most.
class FacetSums
{
public:
  FacetSums() = default;

  /// @param tree     outlives this object only where it is asked about its nodes
  /// @param open     for each triangle, which of its sides have not one neighbor that is oriented
  ///                 as it is: bit k, of that from corner k; of such triangles there are no sums
  FacetSums(const BoxTree& tree, const std::vector<std::uint8_t>& open);

  /// @param node  index in the tree
  /// @return      none: its triangles are to be visited
  /// @realtime    no allocation, no lock, no exception
  [[nodiscard]] const FacetSum* of(std::size_t node) const noexcept
  {
    const std::int32_t index = node < index_.size() ? index_[node] : -1;
    return index < 0 ? nullptr : &sums_[at(index)];
  }

  /// The open sides of a facet, of which the rim of what is within reach does not tell.
  /// @param facet  index in the tree
  /// @realtime     no allocation, no lock, no exception
  [[nodiscard]] std::uint8_t openSides(int facet) const noexcept
  {
    return open_.empty() ? std::uint8_t{ 0 } : open_[at(facet)];
  }

private:
  std::vector<std::int32_t> index_; // per node, -1: none
  std::vector<FacetSum> sums_;
  std::vector<std::uint8_t> open_; // per facet; empty: none
};

} // namespace palp
