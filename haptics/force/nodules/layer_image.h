#pragma once

#include "haptics/force/linear/layer.h"
#include "haptics/force/nodules/strain.h"
#include "haptics/numerics/cubic_spline.h"

#include <array>
#include <vector>

namespace palp
{

/// What the base of a layer adds to the strain under a point load on a half-space.
/// @source general solution of a layer in Hankel's wavenumbers; half-space: Boussinesq 1885
class LayerImage
{
public:
  static constexpr double kReach = 3.0; ///< r / thickness; farther, a layer is hardly strained

  /// @param poissonRatio  nu, 0 to less than 0.5
  LayerImage(double poissonRatio, Base base);

  /// @param r  from the load, over the thickness, 0 to kReach
  /// @param z  below the surface, over the thickness, 0 to 1
  /// @return   strain E thickness^2 / load [-]
  [[nodiscard]] Strain operator()(double r, double z) const noexcept;

private:
  std::vector<BicubicSpline> parts_; // in the order of Strain
};

} // namespace palp
