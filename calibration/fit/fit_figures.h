#pragma once

#include "calibration/figures/figure.h"
#include "calibration/fit/modulus_fit.h"

#include <span>

namespace palp::fit
{

/// A curve with the rows that were fitted, and what came out.
struct FittedCurve
{
  std::string name; ///< of its own among all of them
  Measured loading;
  ModulusFit fit;
};

/// Measured force, fitted force and residual of every row, as fit.csv.
[[nodiscard]] figures::Table fitTable(std::span<const FittedCurve> curves);

/// fit: measured and fitted forces; residuals: what is left.
[[nodiscard]] std::vector<figures::Figure> fitFigures(std::span<const FittedCurve> curves);

} // namespace palp::fit
