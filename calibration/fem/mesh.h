#pragma once

#include "calibration/fem/body.h"
#include "calibration/fem/mesh_steps.h"
#include "haptics/force/linear/coating.h"
#include "haptics/force/linear/layer.h"

namespace palp::fem
{

/// Where an eight-node quadrilateral samples its energy.
enum class Integration
{
  Reduced, ///< four points: no locking, no spurious mode
  Full,    ///< nine points: a surface stretched several times over by a sharp tool does not fold
};

/// A ball of another stiffness on the axis, bonded to what is around it.
struct Inclusion
{
  double radius = 0.0; ///< [m]; 0: none
  double top = 0.0;    ///< depth of its highest point [m]
  Material material{};
};

/// A block as the cylinder of equal area under an axisymmetric tool; side free.
///
/// Eight-node quadrilaterals.
///
/// @param radius      of the cylinder [m]
/// @param height      [m], that of the coatings included
/// @param coatings    thinner than the height together
/// @param fineRadius  elements have the size `fine` up to here [m]
/// @param fine        largest element under the tool [m]
/// @param inclusion   whose border the sides of elements follow; without coatings
[[nodiscard]] Body cylinderBody(double radius, double height, double fineRadius, double fine,
  const Coatings& coatings = {}, Integration integration = Integration::Reduced,
  Base base = Base::Bonded, const Refinement& refinement = {}, const Inclusion& inclusion = {});

/// How an elastic sphere is held.
enum class SphereSupport
{
  LowerHalf, ///< everything below the equator fixed
  BottomCap, ///< glued within 45 degrees of the lowest point
};

/// An elastic sphere, pressed at its top.
/// @param radius  R0 [m]
[[nodiscard]] Body sphereBody(double radius, SphereSupport support, double fineRadius, double fine);

/// The paper's volumetric block: width x width x height, n x n x layers nodes, base bonded.
///
/// Eight-node hexahedra with mean dilatation. One quarter is solved; where n is even the elements
/// across the middle planes are kept whole, their far nodes being images of the near ones.
///
/// The nodes crowd towards the tool: their distance grows by one ratio from there.
///
/// @param n       nodes along each side, 4 or more
/// @param layers  nodes along the height, 2 or more
/// @param fine    distance of nodes under the tool [m], at most width / (n - 1), which spaces them
///                evenly, and height / 5
/// @source        Sec. 4.3: 100 x 100 x 30 mm, 30 x 30 x 10 nodes
[[nodiscard]] Body blockBody(double width, double height, int n, int layers, double fine);

} // namespace palp::fem
