#pragma once

#include "haptics/force/linear/coating.h"

#include <vector>

namespace palp::fem
{

/// Smaller elements around one radius: a tool's point, or the edge of its flat.
struct Refinement
{
  double radius = 0.0; ///< where the smallest are [m]
  double size = 0.0;   ///< of the smallest [m]; 0: none
};

constexpr double kOutwardGrowth = 1.15; ///< changes R_d of the paper's block by less than 0.02 mm
constexpr double kDownwardGrowth = 1.1;

/// Element boundaries from 0 to length: steps of `fine` up to fineLength, then growing.
///
/// @param growth  ratio of neighboring steps beyond fineLength, 1 or more
[[nodiscard]] std::vector<double> gradedSteps(
  double length, double fineLength, double fine, double growth);

/// Smallest around one radius, at most `fine` up to fineRadius, then growing.
[[nodiscard]] std::vector<double> refinedSteps(
  double radius, double fineRadius, double fine, const Refinement& refinement);

/// Depths at which the sheets of a coated body begin, and its own end [m].
[[nodiscard]] std::vector<double> sheetBounds(double height, const Coatings& coatings);

/// Steps that grow with the depth and meet every bound; two at least between two of them.
[[nodiscard]] std::vector<double> sheetSteps(
  const std::vector<double>& bounds, double fine, double growth);

/// The same, squeezed and stretched so that one of them is there.
[[nodiscard]] std::vector<double> stepsThrough(std::vector<double> steps, double there);

} // namespace palp::fem
