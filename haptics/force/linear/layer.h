#pragma once

#include "haptics/force/linear/punch_solution.h"

#include <vector>

namespace palp
{

/// How the body is held below.
enum class Base
{
  Unset,  ///< nobody says; answered as bonded, and flagged where a free part would bend
  Bonded, ///< glued to something rigid
  Slip,   ///< on something rigid, without friction
};

/// Linear elastic layer of one material on a rigid base.
/// @source Lebedev and Ufliand 1958; the kernels: Dhaliwal and Rau 1970, Popov and Hess 2015
class Layer
{
public:
  static constexpr double kWidest = 3.0; ///< a / thickness; wider, the terms go on as lines

  /// @param poissonRatio  nu, 0 to 0.5
  Layer(double poissonRatio, Base base);

  /// @param width  a / thickness, 0 or more
  /// @return       phi, slopes by the width
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] PunchSolution operator()(double width) const noexcept;

private:
  std::vector<PunchSolution> rows_;
};

} // namespace palp
