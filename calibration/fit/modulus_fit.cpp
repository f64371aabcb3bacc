#include "calibration/fit/modulus_fit.h"

#include "calibration/figures/table.h"
#include "haptics/error.h"
#include "haptics/force/linear/layer.h"
#include "haptics/numerics/roots.h"
#include "haptics/threads/followed_work.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palp::fit
{
namespace
{

using namespace units::literals;

constexpr const char* kPower = "power";
constexpr const char* kLayer = "corrected with thickness";
constexpr double kUnitModulus = 1.0; // [Pa]

// 1 / thickness, so that a half-space is a place like others
double thicknessOf(double inverse)
{
  return inverse > 0.0 ? 1.0 / inverse : std::numeric_limits<double>::infinity();
}

ForceLaw lawOf(const ModulusQuestion& question, LawMode mode)
{
  LawSettings settings = question.settings;
  settings.mode = mode;
  return { question.tip, { kUnitModulus, question.poissonRatio }, settings };
}

CurveModel modelOf(const ModulusQuestion& question, LawMode mode)
{
  const double inverse = 1.0 / question.place.thickness;
  return { .shape =
             [law = lawOf(question, mode), place = question.place](
               double depth, double inverseThickness) mutable
    {
      place.depth = depth;
      place.thickness = thicknessOf(inverseThickness);
      return law(place).force;
    },
    .extra = { inverse, inverse },
    .contact = question.contact,
    .offset = question.offset };
}

// The thinnest body that the law knows a press of: thicker than the tool goes deep, and as the
// contact asks. Thinner ones, where the law goes on as lines, fit the noise of thick ones.
double thinnest(const ModulusQuestion& question, double depth)
{
  const ForceLaw law = lawOf(question, LawMode::Corrected);
  const auto isTooThin = [&](double thickness)
  {
    ContactGeometry place = question.place;
    place.depth = depth;
    place.thickness = thickness;
    return law(place).contactRadius > Layer::kWidest * thickness;
  };
  constexpr int kHalvings = 30;
  const double enough = baseRadius(question.tip) / Layer::kWidest;
  return depth < enough ? bisect(isTooThin, { depth, enough }, kHalvings).high : depth;
}

CurveModel layerModel(const ModulusQuestion& question, const Measured& loading)
{
  CurveModel model = modelOf(question, LawMode::Corrected);
  model.extra = { 0.0, 0.0 };
  const double contact = fitForceCurve(loading, model).contact.value;
  model.extra.high =
    1.0 / thinnest(question, std::max(0.1_mm, loading.depths.maxCoeff() - contact));
  return model;
}

CurveModel powerModel(const ModulusQuestion& question, const Measured& loading)
{
  const double range = loading.depths.maxCoeff() - loading.depths.minCoeff();
  return { .shape = [range](double depth, double exponent)
    { return std::pow(depth / range, exponent); },
    .extra = { 0.5, 6.0 },
    .contact = question.contact,
    .offset = question.offset };
}

LawFit fitted(std::string name, const Measured& loading, const CurveModel& model)
{
  const auto rows = static_cast<double>(loading.depths.size());
  LawFit fit{ .name = std::move(name),
    .curve = fitForceCurve(loading, model),
    .parameters = model.parameters(),
    .aic = 0.0,
    .weight = 0.0 };
  fit.aic = rows * std::log(fit.curve.sumOfSquares / rows) + 2.0 * (fit.parameters + 1);
  return fit;
}

// the laws of a tool; the paper has two of its own
void fitLaws(ModulusFit& fit, const Measured& loading, const ModulusQuestion& question)
{
  const bool isPapers = std::holds_alternative<SphereTip>(question.tip) ||
    std::holds_alternative<ConeTip>(question.tip);
  const LawMode asked = question.settings.mode;
  constexpr double kLaws = 4.0; // usually
  for (const auto& [mode, name] : { std::pair(LawMode::Paper, "paper"),
         std::pair(LawMode::Exact, "exact"), std::pair(LawMode::Corrected, "corrected") })
  {
    tellDone(static_cast<double>(fit.laws.size()) / kLaws);
    if (mode == LawMode::Paper && !isPapers)
    {
      continue;
    }
    if (mode == asked || (asked == LawMode::Paper && mode == LawMode::Exact && !isPapers))
    {
      fit.answer = fit.laws.size();
    }
    fit.laws.push_back(fitted(name, loading, modelOf(question, mode)));
  }
  if (question.searchThickness)
  {
    fit.answer = fit.laws.size();
    fit.laws.push_back(fitted(kLayer, loading, layerModel(question, loading)));
  }
  if (const CurveModel power = powerModel(question, loading);
      loading.depths.size() > power.parameters())
  {
    fit.laws.push_back(fitted(kPower, loading, power));
  }
}

void compare(ModulusFit& fit)
{
  constexpr double kEqual = 1e-6;
  double least = std::ranges::min(fit.laws, {}, &LawFit::aic).aic;
  const auto isLeast = [&](const LawFit& law) { return law.aic <= least + kEqual; };
  fit.best = static_cast<std::size_t>(std::ranges::find_if(fit.laws, isLeast) - fit.laws.begin());
  double all = 0.0;
  for (LawFit& law : fit.laws)
  {
    law.weight = std::exp(0.5 * (least - law.aic));
    all += law.weight;
  }
  for (LawFit& law : fit.laws)
  {
    law.weight /= all;
  }
}

// Durbin and Watson 1950: in noise it is 2 with a deviation of about 2 / sqrt(n)
void judgeResiduals(ModulusFit& fit, const Measured& loading)
{
  constexpr double kRare = 3.1;   // deviations, one time in a thousand
  constexpr double kNoise = 1e-6; // of the largest force; below, digits that are left out
  const LawFit& law = fit.asked();
  const Eigen::VectorXd residuals = loading.forces - law.curve.forces;
  const Eigen::Index rows = residuals.size();
  const double squares = residuals.squaredNorm();
  fit.noise = std::sqrt(law.curve.sumOfSquares / static_cast<double>(rows - law.parameters));
  fit.durbinWatson = squares > 0.0
    ? (residuals.tail(rows - 1) - residuals.head(rows - 1)).squaredNorm() / squares
    : 2.0;
  fit.isSystematic = fit.noise > kNoise * loading.forces.lpNorm<Eigen::Infinity>() &&
    2.0 - fit.durbinWatson > kRare * 2.0 / std::sqrt(static_cast<double>(rows));
}

// of what a law takes; see makeMaterial
void refuseStrange(double modulus)
{
  if (!(modulus >= 1.0 && modulus <= 1e10))
  {
    throw Error(ErrorCode::BadValue,
      "Young's modulus comes out as " + figures::shown(modulus) +
        " Pa, not 1 Pa to 10 GPa; give depths in mm and forces in N, and the tool that pressed");
  }
}

} // namespace

const Estimate* ModulusFit::exponent() const noexcept
{
  return laws.back().name == kPower ? &laws.back().curve.extra : nullptr;
}

std::optional<Estimate> ModulusFit::thickness() const noexcept
{
  if (asked().name != kLayer)
  {
    return std::nullopt;
  }
  const auto& [value, low, high] = asked().curve.extra;
  return Estimate{ thicknessOf(value), std::isinf(high) ? 0.0 : thicknessOf(high),
    thicknessOf(low) };
}

ModulusFit fitModulus(const Measured& loading, const ModulusQuestion& question)
{
  if (!(loading.forces.maxCoeff() > 0.0))
  {
    throw Error(ErrorCode::BadValue,
      "no force is above 0; give the force that pushes the tool out as positive");
  }
  ModulusFit fit;
  fitLaws(fit, loading, question);
  compare(fit);
  judgeResiduals(fit, loading);
  const CurveFit& answer = fit.asked().curve;
  refuseStrange(answer.scale.value);
  fit.deepest = question.place;
  fit.deepest.depth = loading.depths.maxCoeff() - answer.contact.value;
  if (question.searchThickness)
  {
    fit.deepest.thickness = thicknessOf(answer.extra.value);
  }
  return fit;
}

} // namespace palp::fit
