#include "calibration/experiments/experiment_parts.h"
#include "calibration/study/curve_fit.h"
#include "calibration/study/surface_fit.h"
#include "haptics/files/fixed_text.h"

#include <algorithm>
#include <cmath>

// Figs. 7 and 8

namespace palp::fem
{
namespace
{

using namespace parts;
using namespace units::literals;
using units::toMillimeters;

// R_d [mm] at every depth that was reached
std::vector<double> extentsOf(const Case& study, const std::stop_token& stop)
{
  std::vector<double> radii(study.depths.size(), kMissing);
  const Outcome outcome = calibrate(study, stop);
  for (std::size_t i = 0; i < outcome.steps.size(); ++i)
  {
    radii[i] = toMillimeters(extentRadius(outcome.steps[i].profile, study.threshold));
  }
  return radii;
}

Points polynomial(const PolynomialFit& fit)
{
  constexpr int kPoints = 100;
  Points result;
  for (int i = 0; i <= kPoints; ++i)
  {
    const double x = fit.upTo * i / kPoints;
    const double y = fit(x);
    if (y >= 0.0)
    {
      result.x.push_back(x);
      result.y.push_back(y);
    }
  }
  return result;
}

// one tool of Fig. 8; returns the largest difference of the two moduli [mm]
double addExtents(Experiment& result, bool sphere, const std::vector<double>& depths,
  Resolution resolution, const std::stop_token& stop)
{
  const std::string name = sphere ? "sphere" : "cone";
  Case study =
    paperBlock(tool(sphere, 10.0_mm), 50.0_mm, StrainEnergy::NeoHookean, depths, resolution);
  const auto soft = extentsOf(study, stop);
  study.material.youngModulus = 1.5_MPa;
  const auto stiff = extentsOf(study, stop);
  addColumn(result, name + "_50kPa_mm", soft);
  addColumn(result, name + "_1500kPa_mm", stiff);

  double apart = 0.0;
  std::vector<double> reached;
  std::vector<double> radii;
  for (std::size_t i = 0; i < depths.size() && !std::isnan(soft[i]); ++i)
  {
    apart = std::max(apart, std::abs(stiff[i] - soft[i]));
    reached.push_back(toMillimeters(depths[i]));
    radii.push_back(soft[i]);
  }
  const ExtentFits fits = fitExtent(reached, radii);
  const int color = sphere ? 1 : 4;
  addCurve(result,
    { .label = name + ", 50 kPa and 1.5 MPa", .style = Curve::Style::Circles, .color = color },
    pointsOf(result, name + "_50kPa_mm"));
  if (fits.linearHoldsTo > 0.0)
  {
    addCurve(result,
      { .label = name + ", line to " + fixed(fits.linearHoldsTo, 1) + " mm", .color = color + 1 },
      polynomial(fits.linear));
  }
  addCurve(
    result, { .label = name + ", parabola", .color = color + 2 }, polynomial(fits.quadratic));
  result.finding += (sphere ? "Sphere: R_d = " : "Cone: R_d = ") + fixed(largest(radii), 1) +
    " mm at the last depth; " +
    (fits.linearHoldsTo > 0.0 ? "a line holds to " + fixed(fits.linearHoldsTo, 1) + " mm"
                              : std::string("no line holds from the start")) +
    (sphere ? " (paper: about 7 mm)" : "") + ", a parabola leaves " +
    fixed(fits.quadratic.worst, 2) + " mm. ";
  return apart;
}

struct Fractions
{
  double paper = 0.0; // largest rms over depth [-]
  double fitted = 0.0;
};

// one depth of Fig. 7
void addProfile(
  Experiment& result, const Case& study, const IndentationStep& step, Fractions& fractions)
{
  const double extent = extentRadius(step.profile, study.threshold);
  const SurfaceProfile fit = fitSurface(step, study.tip);
  const auto paper = [&](double radius)
  { return paperSink(study.tip, step.depth, step.contactRadius, extent, radius); };
  const auto fitted = [&](double radius) { return fit.sinkAt(radius); };
  fractions.paper =
    std::max(fractions.paper, surfaceError(step, fit.outer, paper).rms / step.depth);
  fractions.fitted =
    std::max(fractions.fitted, surfaceError(step, fit.outer, fitted).rms / step.depth);

  Points elements;
  Points drawn;
  Points closer;
  const double sphere = std::holds_alternative<SphereTip>(study.tip) ? 0.0 : 1.0;
  for (const auto& point : step.profile)
  {
    const double radius = point.radius + point.ur;
    const bool outside = radius > step.contactRadius;
    const double x = toMillimeters(radius);
    const double height = toMillimeters(point.uz);
    const double ring = outside ? -toMillimeters(paper(radius)) : kMissing;
    const double curve = outside ? -toMillimeters(fitted(radius)) : kMissing;
    result.numbers.rows.push_back({ x, sphere, toMillimeters(step.depth), height, ring, curve });
    elements.x.push_back(x);
    elements.y.push_back(height);
    if (outside)
    {
      drawn.x.push_back(x);
      drawn.y.push_back(ring);
      closer.x.push_back(x);
      closer.y.push_back(curve);
    }
  }
  const bool first = result.figures.back().curves.empty(); // one entry in the legend for all depths
  addCurve(result, { .label = first ? "finite elements" : "", .color = 1 }, elements);
  addCurve(result, { .label = first ? "paper, Eq. (8)" : "", .color = 2 }, drawn);
  addCurve(result, { .label = first ? "fitted" : "", .color = 3 }, closer);
}

} // namespace

Experiment extents(Resolution resolution, const std::stop_token& stop)
{
  const auto depths = depthSteps(0.5_mm, 10.0_mm, resolution);
  Experiment result = overDepth("extents", depths);
  addFigure(result,
    { .name = "extents",
      .caption = "Fig. 8: radius of the deformed region, R = 10 mm, block of 50 mm",
      .bottom = "depth \u03b4 [mm]",
      .left = "R_d [mm]" });
  const double sphere = addExtents(result, true, depths, resolution, stop);
  const double cone = addExtents(result, false, depths, resolution, stop);
  result.finding += "The cone's is smaller, as the paper says. 50 kPa and 1.5 MPa give the same "
                    "R_d (" +
    fixed(std::max(sphere, cone), 3) +
    " mm apart), as statics demands; the different curves of the paper's Figs. 7 and 8 cannot come "
    "from "
    "elasticity.";
  return result;
}

Experiment profiles(Resolution resolution, const std::stop_token& stop)
{
  Experiment result = experimentOf(
    "profiles", { "radius_mm", "tool", "depth_mm", "finite_elements_mm", "paper_mm", "fitted_mm" });
  for (const bool sphere : { true, false })
  {
    // the same depths however quick: they are the paper's four pictures
    Case study = paperBlock(tool(sphere, 10.0_mm), 50.0_mm, StrainEnergy::NeoHookean,
      depthSteps(2.5_mm, 10.0_mm, Resolution::Full), resolution);
    addFigure(result,
      { .name = sphere ? "profiles_sphere" : "profiles_cone",
        .caption = std::string("Fig. 7: surface under the ") + (sphere ? "sphere" : "cone") +
          ", R = 10 mm, at 2.5, 5, 7.5 and 10 mm",
        .bottom = "distance from the axis [mm]",
        .left = "height [mm]" });
    Fractions fractions;
    for (const IndentationStep& step : calibrate(study, stop).steps)
    {
      addProfile(result, study, step, fractions);
    }
    result.finding += std::string(sphere ? "Sphere (tool 0)" : "Cone (tool 1)") +
      ": the paper's quadratic curve, which ends at R_d where the surface is still 0.5 mm deep, "
      "lies up to " +
      fixed(100.0 * fractions.paper, 1) +
      " % of the depth (rms over the radius) off the finite elements, the fitted curve " +
      fixed(100.0 * fractions.fitted, 1) + " %. ";
  }
  result.finding += "The paper's Fig. 7 shows other surfaces for 50 kPa and 1.5 MPa; in statics "
                    "they are the same.";
  return result;
}

} // namespace palp::fem
