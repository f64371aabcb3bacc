#pragma once

#include <filesystem>
#include <memory>
#include <vector>

namespace palp
{

/// Ratio of the neo-Hookean to the linear force on a regular grid, read by interpolation:
/// monotone cubic along the first axis and so smooth in depth, linear along the others.
class LargeStrainGrid
{
public:
  struct Ratio
  {
    double value = 1.0;  ///< F_neo-Hookean / F_linear [-]
    double slope = 0.0;  ///< d value / d first [-]
    bool inside = false; ///< the grid covers the place; outside, the value at its border
  };

  /// @param first    increasing; its last value is where the ratio levels off
  /// @param second   increasing; beyond, the ratio levels off within 0.05
  /// @param poisson  nu, increasing; more than 0.05 beyond the ratio is 1, for it changes sides
  /// @param ratios   [poisson][second][first], the last running fastest; each 0.1 to 10
  /// @throws Error  BadValue: an axis out of order, or another number of ratios
  LargeStrainGrid(std::vector<double> first, std::vector<double> second,
    std::vector<double> poisson, std::vector<double> ratios);

  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] Ratio operator()(double first, double second, double poisson) const noexcept;

  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] bool covers(double second, double poisson) const noexcept;

private:
  [[nodiscard]] Ratio along(std::size_t row, double first) const noexcept;

  std::vector<double> first_;
  std::vector<double> second_;
  std::vector<double> poisson_;
  std::vector<double> ratios_;
  std::vector<double> slopes_; // d ratio / d first, as ratios_
};

/// Large strain of a neo-Hookean layer bonded to its base, by finite elements:
/// W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2, frictionless tip.
///
/// Each ratio compares with the linear layer at the same depth, thickness and nu, so that it
/// multiplies the force after the factor for the thickness.
struct LargeStrain
{
  LargeStrainGrid sphere; ///< first: depth / R; second: R / thickness, 0 for a half-space
  LargeStrainGrid cone;   ///< first: depth / thickness; second: half angle [rad]
};

/// The same ratio for a tip without a table of its own: 1 + c e / (1 + 0.76 e) + k depth /
/// thickness with e = depth / contact radius and quadratics c, k of nu.
///
/// Fitted to `palp calibrate`: within 3.3 % of neo-Hookean over linear elements for punch,
/// paraboloid, cones of 45 to 80 degrees, blunt and truncated ones, and spheres, nu 0 to 0.5.
///
/// @param depth          [m], more than 0
/// @param contactRadius  of the linear law [m]
/// @param thickness      [m], more than 0; infinite for a half-space
/// @realtime             pure; no allocation, no lock, no exception
[[nodiscard]] double largeStrainOf(
  double depth, double contactRadius, double thickness, double poisson) noexcept;

/// Whether it was fitted there: e to 1.6; depth to 0.4 of the thickness at nu to 0.3, to 0.2 from
/// 0.45 on, where a thin layer that keeps its volume stiffens.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] bool isLargeStrainKnown(
  double depth, double contactRadius, double thickness, double poisson) noexcept;

using LargeStrainTable = std::shared_ptr<const LargeStrain>; ///< null: none, the ratio is 1

/// Reads one table for each kind of tip: every combination of the first three columns, in any
/// order.
///
/// @param sphere  `depth_over_radius,radius_over_thickness,poisson_ratio,force_ratio`
/// @param cone    `depth_over_thickness,half_angle_deg,poisson_ratio,force_ratio`
/// @throws Error  BadFile: missing, not such numbers, a combination missing or twice
[[nodiscard]] LargeStrainTable readLargeStrain(
  const std::filesystem::path& sphere, const std::filesystem::path& cone);

} // namespace palp
