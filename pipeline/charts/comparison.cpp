#include "pipeline/charts/comparison.h"

#include "haptics/force/validity.h"
#include "haptics/numerics/polynomial_fit.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palp
{
namespace
{

constexpr int kCurveSteps = 200;

std::vector<double> inMillimeters(std::vector<double> meters)
{
  std::transform(meters.begin(), meters.end(), meters.begin(), &units::toMillimeters);
  return meters;
}

std::vector<double> depthsTo(double deepest)
{
  std::vector<double> depths;
  for (int i = 0; i <= kCurveSteps; ++i)
  {
    depths.push_back(deepest * i / kCurveSteps);
  }
  return depths;
}

std::vector<double> forcesOf(const NamedLaw& law, const std::vector<double>& depths)
{
  std::vector<double> forces(depths.size());
  std::ranges::transform(depths, forces.begin(), [&law](double depth) { return law.force(depth); });
  return forces;
}

// color of the first reference
std::size_t firstReference(const std::vector<NamedLaw>& laws)
{
  std::size_t first = laws.size();
  for (const NamedLaw& law : laws)
  {
    first = std::max(first, law.color.value_or(0) + 1);
  }
  return first;
}

} // namespace

std::unique_ptr<Plot> forcePlot(
  const std::vector<NamedLaw>& laws, double deepest, const std::vector<ReferenceCurve>& references)
{
  auto plot = std::make_unique<Plot>("force over depth", "depth \u03b4 [mm]", "force [N]");
  const std::vector<double> depths = depthsTo(deepest);
  const std::vector<double> shown = inMillimeters(depths);
  const std::vector<double> first = forcesOf(laws.front(), depths);
  const double margin = Validity::kJustNoticeable * first.back();
  std::vector<double> low = first;
  std::vector<double> high = first;
  std::for_each(low.begin(), low.end(), [=](double& f) { f = std::max(0.0, f - margin); });
  std::for_each(high.begin(), high.end(), [=](double& f) { f += margin; });
  plot->addBand("7 % of the largest force", shown, low, high,
    appearance::curveColor(laws.front().color.value_or(0)));
  std::size_t color = 0;
  for (const NamedLaw& law : laws)
  {
    plot->addLine(
      law.name, shown, forcesOf(law, depths), appearance::curveColor(law.color.value_or(color)));
    ++color;
  }
  color = firstReference(laws);
  for (const ReferenceCurve& reference : references)
  {
    plot->addPoints(
      reference.name, inMillimeters(reference.x), reference.y, appearance::curveColor(color++));
  }
  return plot;
}

std::unique_ptr<Plot> forceErrorPlot(
  const std::vector<NamedLaw>& laws, double deepest, const std::vector<ReferenceCurve>& references)
{
  const NamedLaw& law = laws.front();
  auto plot = std::make_unique<Plot>(
    law.name + " against the references", "depth \u03b4 [mm]", "difference [% of the largest]");
  const std::vector<double> shown = inMillimeters(depthsTo(deepest));
  const std::vector<double> low(shown.size(), -100.0 * Validity::kJustNoticeable);
  const std::vector<double> high(shown.size(), 100.0 * Validity::kJustNoticeable);
  plot->addBand("just noticed by a hand", shown, low, high, appearance::curveColor(0));
  std::size_t color = firstReference(laws);
  for (const ReferenceCurve& reference : references)
  {
    const double largest = *std::max_element(reference.y.begin(), reference.y.end());
    std::vector<double> error;
    for (std::size_t i = 0; i < reference.x.size(); ++i)
    {
      const double ours = law.force(reference.x[i]);
      error.push_back(100.0 * (ours - reference.y[i]) / largest);
    }
    plot->addLine(
      reference.name, inMillimeters(reference.x), error, appearance::curveColor(color++));
  }
  return plot;
}

std::unique_ptr<Plot> extentPlot(
  const ExtentTable& table, const std::vector<ReferenceCurve>& references)
{
  auto plot = std::make_unique<Plot>("extent over depth", "depth \u03b4 [mm]", "R_d [mm]");
  std::vector<double> depths;
  std::vector<double> radii;
  std::vector<double> fittedDepths; // where the surface sinks by the threshold
  std::vector<double> fittedRadii;
  for (const ExtentTable::Extent& row : table.rows())
  {
    depths.push_back(units::toMillimeters(row.depth));
    radii.push_back(units::toMillimeters(row.extentRadius));
    if (row.extentRadius > 0.0)
    {
      fittedDepths.push_back(depths.back());
      fittedRadii.push_back(radii.back());
    }
  }
  const PolynomialFit fit = fitPolynomial(fittedDepths, fittedRadii, 2);
  const std::vector<double> shown = inMillimeters(depthsTo(table.rows().back().depth));
  std::vector<double> line;
  std::vector<double> curve;
  for (const double depth : shown)
  {
    line.push_back(units::toMillimeters(table.extentRadius(units::fromMillimeters(depth))));
    curve.push_back(std::max(0.0, fit(depth)));
  }
  plot->addLine("table, linear in between", shown, line, appearance::curveColor(0));
  if (!fit.coefficients.empty())
  {
    plot->addLine("quadratic fit", shown, curve, appearance::curveColor(1));
  }
  plot->addPoints("table", depths, radii, appearance::curveColor(0));
  std::size_t color = 2;
  for (const ReferenceCurve& reference : references)
  {
    plot->addPoints(reference.name, inMillimeters(reference.x), inMillimeters(reference.y),
      appearance::curveColor(color++));
  }
  return plot;
}

} // namespace palp
