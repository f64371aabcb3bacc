#pragma once

#include <stop_token>
#include <string>
#include <vector>

namespace palp::fem
{

/// An experiment of the paper done again: numbers, and what they say about the paper's.
struct Experiment
{
  std::string name;                 ///< of the file
  std::vector<std::string> columns; ///< the first is the abscissa; each name ends in its unit
  std::vector<std::vector<double>> rows;
  std::string finding; ///< a few sentences
};

/// Comma-separated values, the finding as comments above them.
[[nodiscard]] std::string csv(const Experiment& experiment);

/// Force on elastic spheres of 30, 50 and 100 mm against the block, two supports, both tools.
/// @source Sec. 3.2, Eq. (6), Fig. 3
[[nodiscard]] Experiment curvature(std::stop_token stop = {});

/// Angles at which inclination is felt.
/// @source Sec. 3.2, Eq. (7)
[[nodiscard]] Experiment inclination();

/// R_d over depth of sphere and cone, two Young's moduli.
/// @source Sec. 3.3.2, Fig. 8
[[nodiscard]] Experiment extents(std::stop_token stop = {});

/// Surface profiles of sphere and cone at 2.5, 5, 7.5 and 10 mm, with the paper's and the fitted
/// curve.
/// @source Sec. 3.3.2, Fig. 7
[[nodiscard]] Experiment profiles(std::stop_token stop = {});

/// Eqs. (4) and (5) against linear, corotated and neo-Hookean finite elements, and the depths at
/// which they part by 7 %.
/// @source Sec. 4.3, Eq. (9), Figs. 15 and 16
[[nodiscard]] Experiment forces(std::stop_token stop = {});

} // namespace palp::fem
