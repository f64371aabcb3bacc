#pragma once

#include "data/implicit.h"
#include "data/shapes.h"

#include <Eigen/Core>
#include <string>
#include <vector>

namespace palp
{

/// A part of a phantom, in what is listed before it.
struct PhantomPart
{
  std::string name; ///< of its file
  Distance distance;
  Mesh surface;        ///< closed [m]
  std::string label{}; ///< what its voxels are that no later part has; empty: as its name
};

/// A ball of other tissue in the first part.
struct PhantomNodule
{
  Eigen::Vector3d center; ///< [m]
  double radius;          ///< [m]
};

/// A body whose shape is known by formulas.
struct Phantom
{
  std::vector<PhantomPart> parts; ///< the body that is pressed first; label 1, 2, ... of a voxel
  std::vector<PhantomNodule> nodules{}; ///< that the last part consists of; empty: none
  Eigen::Vector3d low;                  ///< corners of a box with all of it [m]
  Eigen::Vector3d high;                 ///< [m]
};

/// The paper's block of 100 x 100 x 50 mm, its upper face at z = 0.
[[nodiscard]] Phantom blockPhantom();

/// A block of 120 x 120 x 62 mm of liver under 10 mm of fat under 2 mm of skin, at z = 0.
[[nodiscard]] Phantom slabPhantom();

/// A ball of 30 mm about the origin.
[[nodiscard]] Phantom spherePhantom();

/// The bundled liver with a tree of vessels and five nodules of 4 to 9 mm below 4 to 12 mm of it.
/// @param seed  of the nodules
[[nodiscard]] Phantom liverPhantom(unsigned seed);

} // namespace palp
