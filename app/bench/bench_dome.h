#pragma once

#include "data/shapes.h"
#include "pipeline/deform/dent.h"

namespace palp
{

/// A curved surface of n x n points for benchmarks, and presses that displace a known fraction of
/// it.
struct BenchDome
{
  int n;
  double size; ///< of its side [m], and the radius of its curvature

  /// Centered on the apex, which faces +z.
  [[nodiscard]] Mesh mesh() const;

  /// Radius of a dent of so many points [m].
  [[nodiscard]] double radiusOf(double touched) const;

  /// A sphere pressed by half its radius.
  ///
  /// @param outer  radius of the dent [m]
  /// @param x      distance of its center from the apex [m]
  [[nodiscard]] Press press(double outer, double x) const;
};

} // namespace palp
