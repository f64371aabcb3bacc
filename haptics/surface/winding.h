#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Core>
#include <vector>

namespace palp
{

/// Whether a place is inside a closed surface, told by all of its triangles: of one that crosses
/// itself the nearest one may face either way.
///
/// @source  Jacobson et al., ACM TOG 32(4), 2013; far triangles as dipoles: Barill et al., ACM TOG
///          37(4), 2018; solid angle: Van Oosterom and Strackee, IEEE TBME 30(2), 1983
class Winding
{
public:
  /// @param tree  of all triangles of a closed surface
  explicit Winding(BoxTree tree);

  /// How often the surface goes around a place: 1 inside, 0 outside, between them on it, 2 within a
  /// fold; within 0.05.
  ///
  /// @param position  [m]
  /// @realtime        pure; no allocation, no lock, no exception
  [[nodiscard]] double operator()(const Eigen::Vector3d& position) const noexcept;

private:
  // the triangles of a node
  struct Dipole
  {
    Eigen::Vector3d center = Eigen::Vector3d::Zero(); // weighted by area [m]
    Eigen::Vector3d area = Eigen::Vector3d::Zero();   // sum of the outward vectors [m^2]
    double size = 0.0;                                // sum of their lengths [m^2]
    double squaredRadius = 0.0;                       // about the center [m^2]
  };

  BoxTree tree_;
  std::vector<Dipole> dipoles_; // one for each node
};

} // namespace palp
