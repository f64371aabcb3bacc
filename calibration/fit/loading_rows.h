#pragma once

#include <cstddef>
#include <span>

namespace palp::fit
{

/// Rows of a curve, one after the other.
struct Rows
{
  std::size_t first; ///< from 0
  std::size_t count;
};

/// The rows in which the tool goes in, to the deepest row of all: from the last place before it
/// where the depth had fallen by more than a tenth of its range, which is less in noise alone.
///
/// What comes after, hold and unloading, is left out: tissue relaxes there.
///
/// @param depths   [m] in the order of time
/// @throws Error   BadValue: no row, all of one depth, or the depth only falls
[[nodiscard]] Rows loadingRows(std::span<const double> depths);

} // namespace palp::fit
