#pragma once

#include "calibration/figures/figure.h"

#include <stop_token>
#include <string>
#include <vector>

namespace palp::fem
{

using figures::Curve;
using figures::Figure;
using figures::Points;
using figures::Table;

/// An experiment of the paper done again: numbers, and what they say about the paper's.
struct Experiment
{
  Table numbers; ///< the first column is the abscissa
  std::vector<Figure> figures{};
  std::vector<Table> points{}; ///< of each figure
  std::string finding{};       ///< a few sentences
};

/// How finely an experiment is done.
enum class Resolution
{
  Full,  ///< to the accuracy that the findings state; a minute or two each
  Quick, ///< elements twice the size and half the depths, for a first look; seconds each
};

/// Comma-separated values, the finding as comments above them; empty where there is no value.
[[nodiscard]] std::string csv(const Experiment& experiment);

/// Force on elastic spheres of 30, 50 and 100 mm against the block, two supports, both tools.
/// @source Sec. 3.2, Eq. (6), Fig. 3
[[nodiscard]] Experiment curvature(Resolution resolution, const std::stop_token& stop = {});

/// Angles at which inclination is felt.
/// @source Sec. 3.2, Eq. (7)
[[nodiscard]] Experiment inclination();

/// R_d over depth of sphere and cone, two Young's moduli.
/// @source Sec. 3.3.2, Fig. 8
[[nodiscard]] Experiment extents(Resolution resolution, const std::stop_token& stop = {});

/// Surface profiles of sphere and cone at 2.5, 5, 7.5 and 10 mm, with the paper's and the fitted
/// curve.
/// @source Sec. 3.3.2, Fig. 7
[[nodiscard]] Experiment profiles(Resolution resolution, const std::stop_token& stop = {});

/// Eqs. (4) and (5) against linear, corotated and neo-Hookean finite elements, and the depths at
/// which they part by 7 %.
/// @source Sec. 4.3, Eq. (9), Figs. 15 and 16
[[nodiscard]] Experiment forces(Resolution resolution, const std::stop_token& stop = {});

} // namespace palp::fem
