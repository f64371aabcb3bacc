#pragma once

#include "haptics/force/nodules/homogeneous_press.h"
#include "haptics/force/nodules/nodule.h"
#include "haptics/numerics/cubic_spline.h"

namespace palp
{

/// What one nodule adds to the energy of a press, over the energy without it, baked for reading in
/// constant time at any depth and any distance from the nodule's axis.
class NoduleTable
{
public:
  /// The table at one distance from the nodule.
  struct Aside
  {
    SplineBasis basis;
    double bySquare; ///< of its coordinate, d/d(lateral^2) [1/m^2]
  };

  struct Entry
  {
    double value;      ///< energy that is added over that of the press [-]
    double bySquare;   ///< d/d(lateral^2) [1/m^2]
    double byRoot;     ///< d/d(sqrt(depth)) [1/sqrt(m)]
    double byRootBend; ///< second derivative by it [1/m]
  };

  /// @param press      into tissue as it is where the nodule lies
  /// @param nodule     checked
  /// @param reference  to as deep, whose energy is meant by the energy without the nodule
  /// @throws Error     BadValue: the nodule reaches below the base
  NoduleTable(
    const HomogeneousPress& press, const Nodule& nodule, const HomogeneousPress& reference);

  /// @param lateralSquare  of the distance from the tool's axis to the nodule's [m^2], 0 or more
  /// @realtime             pure; no allocation, no lock, no exception
  [[nodiscard]] Aside at(double lateralSquare) const noexcept;

  /// @param root  of the depth, on the axis of the press
  /// @realtime    pure; no allocation, no lock, no exception
  [[nodiscard]] Entry operator()(const Aside& aside, const SplineBasis& root) const noexcept;

private:
  double reachSquare_; // of the distance at which half of the table lies [m^2]
  BicubicSpline energies_;
};

} // namespace palp
