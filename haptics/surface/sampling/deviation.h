#pragma once

#include "haptics/surface/surface.h"

#include <future>
#include <limits>

namespace palp
{

/// How far two surfaces lie apart.
struct Deviation
{
  double largest = 0.0;        ///< [m]
  double rootMeanSquare = 0.0; ///< [m], of more than 65,536 points by about as many of them
};

/// Distance between two surfaces, from the points of each to the triangles of the other.
/// @param a, b  of one shape; points without a triangle do not count
[[nodiscard]] Deviation deviation(const Surface& a, const Surface& b);

/// How a deviation is sought.
struct DeviationSearch
{
  /// where surfaces are farther apart it may end: more than that is found then [m]
  double most = std::numeric_limits<double>::infinity();
  /// whether each point of one began where that of the same place in the other is, all of them on
  /// triangles: quicker
  bool paired = false;
  std::launch threads = std::launch::async; ///< three, or deferred: the caller's alone
};

/// The same of points and of the trees of their triangles, without what a Surface knows besides.
[[nodiscard]] Deviation deviation(std::span<const Eigen::Vector3d> a, const BoxTree& aTree,
  std::span<const Eigen::Vector3d> b, const BoxTree& bTree, const DeviationSearch& search = {});

} // namespace palp
