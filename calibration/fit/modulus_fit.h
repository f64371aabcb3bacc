#pragma once

#include "calibration/fit/force_curve_fit.h"
#include "haptics/force/force_law.h"
#include "haptics/tip/tip.h"

#include <string>
#include <vector>

namespace palp::fit
{

/// What a modulus is told from, besides the curve.
struct ModulusQuestion
{
  Tip tip;
  double poissonRatio;             ///< nu [-], 0 to 0.5
  LawSettings settings{};          ///< its mode: the law that answers; no coatings
  ContactGeometry place{};         ///< whatever its depth
  bool searchThickness = false;    ///< that of the corrected law, which then answers
  std::optional<double> contact{}; ///< depth at which the tool touches [m]; none: searched
  std::optional<double> offset{};  ///< force before the contact [N]; none: searched
};

/// One law, fitted.
struct LawFit
{
  std::string name; ///< paper, exact, corrected, corrected with thickness, power
  CurveFit curve;   ///< scale: E [Pa]; of power, the force at the whole range of depths [N]
  int parameters;   ///< that were searched
  double aic;       ///< n ln(S / n) + 2 (parameters + 1), Akaike 1974
  double weight;    ///< of all laws' evidence, 0 to 1; Burnham and Anderson 2002, Sec. 2.9
};

/// What a curve says of the tissue.
struct ModulusFit
{
  std::vector<LawFit> laws;  ///< those of the tool; power last, where there are rows enough
  std::size_t answer = 0;    ///< the one that was asked for
  std::size_t best = 0;      ///< lowest AIC, the first of equals
  double noise = 0.0;        ///< standard deviation of the forces about the answer [N]
  double durbinWatson = 0.0; ///< of the answer's residuals, 0 to 4; 2 where they are independent
  bool isSystematic = false; ///< too few changes of sign for noise, one time in a thousand
  ContactGeometry deepest{}; ///< the last row, by the answer

  [[nodiscard]] const LawFit& asked() const noexcept
  {
    return laws[answer];
  }

  /// F grows as (depth - contact)^n; null: too few rows.
  [[nodiscard]] const Estimate* exponent() const noexcept;

  /// [m]; null: not searched. Infinite: a half-space.
  [[nodiscard]] std::optional<Estimate> thickness() const noexcept;
};

/// E, contact and exponent of a measured loading curve, by every law that the tool has.
///
/// @param loading  the rows in which the tool goes in
/// @throws Error   BadValue: nu out of its range, no force above 0, a modulus outside of 1 Pa to
///                 10 GPa, and as fitForceCurve
[[nodiscard]] ModulusFit fitModulus(const Measured& loading, const ModulusQuestion& question);

} // namespace palp::fit
