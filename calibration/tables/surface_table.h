#pragma once

#include "calibration/tables/extent_table.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// The surface around a sphere pressed into a bonded neo-Hookean layer, for any radius, thickness
/// and Poisson's ratio; R_d for any threshold follows. Young's modulus plays no part.
///
/// Between its places it is within 2 % of the depth of fresh finite elements, R_d within 0.3 mm or
/// 4 %. The layer is wide: the free sides of the paper's block of 100 mm let R_d grow by up to 7 %
/// more under a sphere of 10 mm.
class SurfaceTable
{
public:
  /// Radii that the table holds, over R.
  static constexpr std::array kRadii{ 0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.25,
    2.5, 2.75, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0 };

  /// A sphere on a layer.
  struct Indentation
  {
    double depth;        ///< delta [m]
    double tipRadius;    ///< R [m]
    double thickness;    ///< of the layer [m]; infinite: as the thickest of the table
    double poissonRatio; ///< nu
  };

  /// Columns of a file: depth / R, R / thickness, nu and the sink over R at each of kRadii.
  [[nodiscard]] static std::string header();

  /// @throws Error  BadFile: missing, another header, not a full grid, or a place twice
  [[nodiscard]] static SurfaceTable read(const std::filesystem::path& file);

  /// Sink of the surface [m], 0 beyond the last radius. Outside the grid, as at its border; beyond
  /// the last depth, growing with it.
  /// @param radius  deformed [m]
  [[nodiscard]] double sinkAt(const Indentation& indentation, double radius) const;

  /// R_d [m], 0 where nothing sinks by the threshold, at most the last radius of the table.
  [[nodiscard]] double extentRadius(const Indentation& indentation, double threshold) const;

  /// R_d over the depth.
  /// @param deepest    the last depth
  /// @param threshold  sink at R_d [m]
  [[nodiscard]] ExtentTable extents(const Indentation& deepest, double threshold) const;

  /// The grid covers it (a depth below its first one included).
  [[nodiscard]] bool covers(const Indentation& indentation) const;

private:
  using Sinks = std::array<double, kRadii.size()>;
  [[nodiscard]] Sinks sinksAt(const Indentation& indentation) const;

  std::array<std::vector<double>, 3> axes_; // nu, R / thickness, depth / R
  std::vector<Sinks> rows_;                 // the last axis running fastest
};

} // namespace palp
