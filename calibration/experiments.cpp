#include "calibration/experiments.h"

#include "calibration/curve_fit.h"
#include "calibration/mesh.h"
#include "calibration/study.h"
#include "calibration/surface_fit.h"
#include "haptics/error.h"
#include "haptics/force/force_law.h"
#include "haptics/force/inclination.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace palp::fem
{
namespace
{

using namespace units::literals;
using units::toMillimetres;

constexpr Material kTissue{ .youngModulus = 50.0_kPa, .poissonRatio = 0.33 };
constexpr double kJnd = 0.07; // just noticeable difference of force, Sec. 3.2 [29]
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

std::vector<double> steps(double step, double last)
{
  std::vector<double> depths;
  for (int i = 1; i * step < last + 0.5 * step; ++i)
  {
    depths.push_back(i * step);
  }
  return depths;
}

Tip cone(double base)
{
  return withCap(ConeTip{ .halfAngle = 45.0_deg, .baseRadius = base }, 0.3_mm);
}

std::string fixed(double value, int digits)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

// presses a body as deep as solutions go
std::vector<double> forcesOn(const Body& body, const Tip& tip, Energy energy,
  const std::vector<double>& depths, const std::stop_token& stop)
{
  Indenter indenter(body, tip, energy, kTissue);
  std::vector<double> result(depths.size(), kMissing);
  for (std::size_t i = 0; i < depths.size() && !stop.stop_requested(); ++i)
  {
    try
    {
      indenter.press(depths[i]);
    }
    catch (const Error&)
    {
      break;
    }
    result[i] = indenter.state().force;
  }
  return result;
}

// the first depth at which the error passes the limit for good; infinite where it never does
double crossing(const std::vector<double>& depths, const std::vector<double>& errors)
{
  double last = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    const double error = std::abs(errors[i]);
    if (error > kJnd)
    {
      return last + (depths[i] - last) * (kJnd - before) / (error - before);
    }
    last = depths[i];
    before = error;
  }
  return std::numeric_limits<double>::infinity();
}

std::string depthText(double depth)
{
  return std::isinf(depth) ? "nowhere" : "at " + fixed(toMillimetres(depth), 1) + " mm";
}

void addColumn(Experiment& experiment, std::string name, const std::vector<double>& values)
{
  experiment.columns.push_back(std::move(name));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    experiment.rows[i].push_back(values[i]);
  }
}

Experiment overDepth(std::string name, const std::vector<double>& depths)
{
  Experiment experiment{
    .name = std::move(name), .columns = { "depth_mm" }, .rows = {}, .finding = {}
  };
  for (const double depth : depths)
  {
    experiment.rows.push_back({ toMillimetres(depth) });
  }
  return experiment;
}

Case paperBlock(const Tip& tip, double height, Energy energy, std::vector<double> depths)
{
  return { .name = "block",
    .height = height,
    .tip = tip,
    .material = kTissue,
    .energy = energy,
    .depths = std::move(depths),
    .elementSize = std::holds_alternative<SphereTip>(tip) ? 1.0_mm : 0.5_mm };
}

} // namespace

std::string csv(const Experiment& experiment)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(7);
  out << "# " << experiment.finding << '\n';
  for (std::size_t i = 0; i < experiment.columns.size(); ++i)
  {
    out << (i == 0 ? "" : ",") << experiment.columns[i];
  }
  out << '\n';
  for (const auto& row : experiment.rows)
  {
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      out << (i == 0 ? "" : ",") << row[i];
    }
    out << '\n';
  }
  return out.str();
}

Experiment curvature(std::stop_token stop)
{
  const auto depths = steps(1.0_mm, 10.0_mm);
  Experiment result = overDepth("curvature", depths);
  result.finding = "Corotated finite elements, Eq. (6). ";
  for (const bool sphere : { true, false })
  {
    const Tip tip = sphere ? Tip{ SphereTip{ 10.0_mm } } : cone(10.0_mm);
    const double size = sphere ? 1.0_mm : 0.5_mm;
    const std::string tool = sphere ? "sphere" : "cone";
    const Body block = bodyOf(paperBlock(tip, 50.0_mm, Energy::Corotated, depths));
    const auto flat = forcesOn(block, tip, Energy::Corotated, depths, stop);
    double most = 0.0;
    for (const double force : flat)
    {
      most = std::isnan(force) ? most : std::max(most, force);
    }
    addColumn(result, tool + "_block_N", flat);
    std::string found;
    for (const auto& [support, word] : { std::pair{ SphereSupport::LowerHalf, "half" },
           std::pair{ SphereSupport::BottomCap, "cap" } })
    {
      double first = std::numeric_limits<double>::infinity();
      for (const double radius : { 30.0_mm, 50.0_mm, 100.0_mm })
      {
        const Body body = sphereBody(radius, support, 11.0_mm, size);
        const auto round = forcesOn(body, tip, Energy::Corotated, depths, stop);
        std::vector<double> error;
        for (std::size_t i = 0; i < depths.size(); ++i)
        {
          error.push_back((round[i] - flat[i]) / most);
        }
        first = std::min(first, crossing(depths, error));
        for (double& e : error)
        {
          e *= 100.0;
        }
        addColumn(result,
          tool + "_R0_" + fixed(toMillimetres(radius), 0) + "mm_" + word + "_percent", error);
      }
      found += std::string(found.empty() ? "" : ", ") + "held on its lower " + word +
        " the first sphere departs by 7 % " + depthText(first);
    }
    result.finding += "The " + tool + " tool presses the block with at most " + fixed(most, 2) +
      " N (" + (sphere ? "paper: 5.66 N" : "paper: not stated") + "); " + found +
      " (paper: beyond " + (sphere ? "9" : "6.5") + " mm). ";
  }
  result.finding += "How the sphere is held matters more than its curvature, and the paper does "
                    "not say how it was.";
  return result;
}

Experiment inclination()
{
  Experiment result{ .name = "inclination",
    .columns = { "tilt_deg", "sphere_normal_loss_percent", "cone_force_change_percent" },
    .rows = {},
    .finding = {} };
  const Tip sharp = ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 10.0_mm };
  double coneLimit = 0.0;
  for (int degree = 0; degree <= 25; ++degree)
  {
    const double tilt = units::fromDegrees(degree);
    const double change = tiltFactor(sharp, tilt) - 1.0;
    coneLimit = change <= kJnd ? degree : coneLimit;
    result.rows.push_back(
      { static_cast<double>(degree), 100.0 * (1.0 - std::cos(tilt)), 100.0 * change });
  }
  result.finding = "Sphere: " + fixed(units::toDegrees(tiltOfShare(kJnd)), 2) +
    " degrees by Eq. (7), which the paper rounds to 22. Cone of 45 degrees: boundary elements on "
    "the linear half-space stay within 7 % up to " +
    fixed(coneLimit, 0) + " degrees (paper: 9, by finite elements on a block).";
  return result;
}

Experiment extents(std::stop_token stop)
{
  const auto depths = steps(0.5_mm, 10.0_mm);
  Experiment result = overDepth("extents", depths);
  double largest = 0.0;
  for (const bool sphere : { true, false })
  {
    const Tip tip = sphere ? Tip{ SphereTip{ 10.0_mm } } : cone(10.0_mm);
    std::vector<double> soft;
    for (const double young : { 50.0_kPa, 1.5_MPa })
    {
      Case study = paperBlock(tip, 50.0_mm, Energy::NeoHookean, depths);
      study.material.youngModulus = young;
      std::vector<double> radii(depths.size(), kMissing);
      const Outcome outcome = calibrate(study, stop);
      for (std::size_t i = 0; i < outcome.steps.size(); ++i)
      {
        radii[i] = toMillimetres(extentRadius(outcome.steps[i].profile, study.threshold));
        largest = soft.empty() ? largest : std::max(largest, std::abs(radii[i] - soft[i]));
      }
      soft = soft.empty() ? radii : soft;
      addColumn(result,
        std::string(sphere ? "sphere_" : "cone_") + fixed(units::toKilopascals(young), 0) +
          "kPa_mm",
        radii);
    }
    std::vector<double> depthsMm;
    std::vector<double> radii;
    for (std::size_t i = 0; i < soft.size() && !std::isnan(soft[i]); ++i)
    {
      depthsMm.push_back(toMillimetres(depths[i]));
      radii.push_back(soft[i]);
    }
    const ExtentFits fits = fitExtent(depthsMm, radii);
    result.finding += std::string(sphere ? "Sphere" : "Cone") +
      ": R_d = " + (radii.empty() ? "none" : fixed(radii.back(), 1)) +
      " mm at the last depth; a line holds to " + fixed(fits.linearHoldsTo, 1) + " mm" +
      (sphere ? " (paper: about 7 mm)" : "") + ", a parabola leaves " +
      fixed(fits.quadratic.worst, 2) + " mm. ";
  }
  result.finding += "50 kPa and 1.5 MPa give the same R_d (largest difference " +
    fixed(largest, 6) +
    " mm), as statics demands; the different curves of the paper's Figs. 7 and "
    "8 cannot come from elasticity.";
  return result;
}

Experiment profiles(std::stop_token stop)
{
  Experiment result{ .name = "profiles",
    .columns = { "radius_mm", "tool", "depth_mm", "finite_elements_mm", "paper_mm", "fitted_mm" },
    .rows = {},
    .finding = {} };
  for (const bool sphere : { true, false })
  {
    const Tip tip = sphere ? Tip{ SphereTip{ 10.0_mm } } : cone(10.0_mm);
    const Case study = paperBlock(tip, 50.0_mm, Energy::NeoHookean, steps(2.5_mm, 10.0_mm));
    double paperWorst = 0.0;
    double fittedWorst = 0.0;
    for (const Indented& step : calibrate(study, stop).steps)
    {
      const double extent = extentRadius(step.profile, study.threshold);
      const SurfaceProfile curve = fitSurface(step, tip);
      const auto paper = [&](double radius)
      { return paperSink(tip, step.depth, step.contactRadius, extent, radius); };
      const auto fitted = [&](double radius) { return curve.sinkAt(radius); };
      paperWorst = std::max(paperWorst, surfaceError(step, curve.outer, paper).rms / step.depth);
      fittedWorst = std::max(fittedWorst, surfaceError(step, curve.outer, fitted).rms / step.depth);
      for (const auto& point : step.profile)
      {
        const double radius = point.radius + point.ur;
        const bool outside = radius > step.contactRadius;
        result.rows.push_back(
          { toMillimetres(radius), sphere ? 0.0 : 1.0, toMillimetres(step.depth),
            toMillimetres(point.uz), outside ? -toMillimetres(paper(radius)) : kMissing,
            outside ? -toMillimetres(fitted(radius)) : kMissing });
      }
    }
    result.finding += std::string(sphere ? "Sphere (tool 0)" : "Cone (tool 1)") +
      ": the paper's quadratic curve, which ends at R_d where the surface is still 0.5 mm deep, "
      "lies " +
      fixed(100.0 * paperWorst, 1) +
      " % of the depth (rms) off the finite elements, the fitted curve " +
      fixed(100.0 * fittedWorst, 1) + " %. ";
  }
  return result;
}

Experiment forces(std::stop_token stop)
{
  const auto depths = steps(0.5_mm, 8.0_mm);
  Experiment result = overDepth("forces", depths);
  for (const bool sphere : { true, false })
  {
    const Tip tip = sphere ? Tip{ SphereTip{ 6.0_mm } } : cone(6.0_mm);
    const Tip sharp = sphere ? tip : Tip{ ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 6.0_mm } };
    const ForceLaw law(sharp, kTissue);
    const std::string tool = sphere ? "sphere_" : "cone_";
    std::vector<double> paper;
    for (const double depth : depths)
    {
      paper.push_back(law(Indentation{ .depth = depth }).force);
    }
    addColumn(result, tool + "paper_N", paper);
    for (const Energy energy : { Energy::Linear, Energy::Corotated, Energy::NeoHookean })
    {
      const Body body = bodyOf(paperBlock(tip, 30.0_mm, energy, depths));
      const auto found = forcesOn(body, tip, energy, depths, stop);
      addColumn(result, tool + std::string(name(energy)) + "_N", found);
      for (const double deepest : { 5.0_mm, 8.0_mm })
      {
        std::vector<double> within;
        std::vector<double> errors;
        double most = 0.0;
        for (std::size_t i = 0; i < depths.size(); ++i)
        {
          if (depths[i] < deepest + 0.1_mm && !std::isnan(found[i]))
          {
            within.push_back(depths[i]);
            most = std::max({ most, found[i], paper[i] });
          }
        }
        for (std::size_t i = 0; i < within.size(); ++i)
        {
          errors.push_back((paper[i] - found[i]) / most);
        }
        if (sphere)
        {
          result.finding += std::string(name(energy)) + ", f_m up to " +
            fixed(toMillimetres(deepest), 0) + " mm: 7 % " + depthText(crossing(within, errors)) +
            ". ";
        }
      }
    }
  }
  result.finding +=
    "Paper (sphere): 3.3 mm for neo-Hookean, 4.3 mm for linear, which there means "
    "corotated; both depend on f_m of Eq. (9), the largest force of the experiment, whose depth "
    "the paper leaves open.";
  return result;
}

} // namespace palp::fem
