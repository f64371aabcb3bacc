#pragma once

#include "haptics/force/relaxation/contact_rows.h"
#include "haptics/force/relaxation/prony_series.h"

#include <span>
#include <vector>

namespace palp
{

/// A tool at a depth at a time; between two of them the depth is linear.
struct PressPoint
{
  double time;  ///< [s]
  double depth; ///< [m], below the surface as it was before any press; negative: apart
};

/// The force of relaxing tissue at each point of a press, which begins at rest.
///
/// @param rows     made for its largest depth
/// @param history  times increase
/// @return         [N]; that of the instantaneous modulus at the first point
[[nodiscard]] std::vector<double> forcesOver(
  const ContactRows& rows, const PronySeries& series, std::span<const PressPoint> history);

} // namespace palp
