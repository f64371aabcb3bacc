#include "calibration/study/shipped_tables.h"

#include "calibration/study/study.h"
#include "calibration/study/study_files.h"
#include "calibration/study/surface_fit.h"
#include "calibration/tables/surface_table.h"
#include "haptics/files/replace_file.h"
#include "haptics/numerics/polynomial_fit.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <sstream>

namespace palp::fem
{
namespace
{

using namespace units::literals;
using units::toMillimeters;
using Tell = std::function<void(const std::string&)>;

constexpr double kRadius = 10.0_mm; // of the sphere that stands for all
constexpr std::array kDepths{ 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0 };
constexpr std::array kRadiusOverThickness{ 0.05, 0.1, 0.2, 0.35, 0.5 };
constexpr std::array kPoisson{ 0.0, 0.2, 0.33, 0.45, 0.49 };
constexpr std::array kConeDegrees{ 45.0, 60.0 }; // sharper ones scatter by 5 % on this mesh
constexpr std::array kConePoisson{ 0.0, 0.2, 0.33, 0.45 };
constexpr double kConeThickness = 50.0_mm;
constexpr double kCap = 0.3_mm;

std::ostringstream table(const std::string& header)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(6);
  out << "# palp " << PALP_VERSION << ": palp calibrate --tables DIR\n" << header;
  return out;
}

// a layer so wide that its side is not felt
Case layer(const std::string& name, const Tip& tip, double thickness, double poisson)
{
  const double width = std::sqrt(std::numbers::pi) * (8.0 * baseRadius(tip) + 3.0 * thickness);
  return { .name = name,
    .width = width,
    .length = width,
    .height = thickness,
    .tip = tip,
    .material = { 50.0_kPa, poisson },
    .elementSize = 0.5_mm };
}

Outcome with(StrainEnergy energy, Case study, const std::stop_token& stop)
{
  study.energy = energy;
  return calibrate(study, stop);
}

// the rows that both reached; beyond, the last ratio
std::vector<double> ratios(
  const Case& study, const Outcome& large, std::string& notes, const std::stop_token& stop)
{
  const Outcome small = with(StrainEnergy::Linear, study, stop);
  std::vector<double> result;
  for (std::size_t i = 0; i < study.depths.size(); ++i)
  {
    const bool reached = i < large.steps.size() && i < small.steps.size();
    if (!reached && i == std::min(large.steps.size(), small.steps.size()))
    {
      notes += "# " + study.name + ": constant beyond " +
        std::to_string(toMillimeters(study.depths[i - 1])) + " mm, where the finite elements end\n";
    }
    result.push_back(reached ? large.steps[i].force / small.steps[i].force
        : result.empty()     ? 1.0
                             : result.back());
  }
  return result;
}

// force ratios over depth, beginning with that of no depth
void addRatios(std::ostream& out, double first, std::span<const double> depths, double column,
  double poisson, const std::vector<double>& ratioOf)
{
  out << "0," << column << ',' << poisson << ',' << first << '\n';
  for (std::size_t i = 0; i < ratioOf.size(); ++i)
  {
    out << depths[i] << ',' << column << ',' << poisson << ',' << ratioOf[i] << '\n';
  }
}

// sink of the surface over the radius, for every depth
void addSurfaces(std::ostream& out, const Outcome& large, double ratio, double poisson)
{
  for (std::size_t i = 0; i < large.steps.size(); ++i)
  {
    out << kDepths[i] << ',' << ratio << ',' << poisson;
    for (const double radius : SurfaceTable::kRadii)
    {
      out << ',' << sinkOf(large.steps[i], radius * kRadius) / kRadius;
    }
    out << '\n';
  }
}

// The contact's radius scatters over the depth by some percent of an element, which a picture
// would show as a shiver from depth to depth.
void smoothContactRadii(std::vector<IndentationStep>& steps)
{
  constexpr int kDegree = 4;
  std::vector<double> depths;
  std::vector<double> radii;
  for (const IndentationStep& step : steps)
  {
    depths.push_back(std::log(step.depth));
    radii.push_back(std::log(step.contactRadius));
  }
  const PolynomialFit power = fitPolynomial(depths, radii, kDegree);
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    steps[i].contactRadius = std::exp(power(depths[i]));
  }
}

void makeExtentTables(
  const std::filesystem::path& folder, const std::stop_token& stop, const Tell& tell)
{
  struct Shipped
  {
    const char* name;
    Tip tip;
    double height;
  };
  const auto cone = [](double base)
  { return Tip{ BluntConeTip{ .halfAngle = 45.0_deg, .tipRadius = kCap, .baseRadius = base } }; };
  const std::array all{ Shipped{ "sphere_r10_h50", SphereTip{ 10.0_mm }, 50.0_mm },
    Shipped{ "sphere_r6_h30", SphereTip{ 6.0_mm }, 30.0_mm },
    Shipped{ "cone45_r10_h50", cone(10.0_mm), 50.0_mm },
    Shipped{ "cone45_r6_h30", cone(6.0_mm), 30.0_mm } };
  for (const Shipped& shipped : all)
  {
    tell(shipped.name);
    Case study{ .name = shipped.name, .height = shipped.height, .tip = shipped.tip };
    for (int i = 1; i <= 20; ++i)
    {
      study.depths.push_back(i * 0.5_mm);
    }
    Outcome outcome = calibrate(study, stop);
    if (stop.stop_requested())
    {
      return; // the table that is there is better than half of a new one
    }
    const auto header = describe(study, bodyOf(study));
    std::ostringstream extents;
    extents << tableText(study, header, outcome);
    replaceFile(folder / (std::string(shipped.name) + ".csv"), extents.view());

    auto curves = table(header +
      "# fitted surface: Bezier curve of degree 5 over 1/radius, "
      "calibration/tables/surface_profile.h\n"
      "depth_mm,inner_mm,outer_mm,sink_mm,slope,control_outer_mm,control_inner_mm\n");
    smoothContactRadii(outcome.steps);
    for (const IndentationStep& step : outcome.steps)
    {
      const SurfaceProfile curve = fitSurface(step, study.tip);
      curves << toMillimeters(step.depth) << ',' << toMillimeters(curve.inner) << ','
             << toMillimeters(curve.outer) << ',' << toMillimeters(curve.sink) << ',' << curve.slope
             << ',' << toMillimeters(curve.control[0]) << ',' << toMillimeters(curve.control[1])
             << '\n';
    }
    replaceFile(folder / (std::string(shipped.name) + "_surface.csv"), curves.view());
  }
}

void makeSphereTables(
  const std::filesystem::path& folder, const std::stop_token& stop, const Tell& tell)
{
  std::string notes;
  std::ostringstream forces;
  std::ostringstream surfaces;
  forces.precision(5);
  surfaces.precision(5);
  for (const double poisson : kPoisson)
  {
    for (const double ratio : kRadiusOverThickness)
    {
      if (stop.stop_requested())
      {
        return;
      }
      std::ostringstream name;
      name << "R / thickness " << ratio << ", nu " << poisson;
      tell("sphere, " + name.str());
      Case study = layer(name.str(), SphereTip{ kRadius }, kRadius / ratio, poisson);
      for (const double depth : kDepths)
      {
        study.depths.push_back(depth * kRadius);
      }
      const Outcome large = with(StrainEnergy::NeoHookean, study, stop);
      const auto ratioOf = ratios(study, large, notes, stop);
      // the thickest layer also stands for the half-space
      const bool thickest = ratio == kRadiusOverThickness.front();
      for (const double row : thickest ? std::vector{ 0.0, ratio } : std::vector{ ratio })
      {
        addRatios(forces, 1.0, kDepths, row, poisson, ratioOf);
      }
      addSurfaces(surfaces, large, ratio, poisson);
    }
  }
  if (stop.stop_requested())
  {
    return; // in the last of them
  }
  auto ratioTable =
    table("# Force of a neo-Hookean layer under a sphere over that of the linear one, same mesh.\n"
          "# W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2; bonded, frictionless, elements of R "
          "/ 20\n" +
      notes + "depth_over_radius,radius_over_thickness,poisson_ratio,force_ratio\n");
  ratioTable << forces.str();
  replaceFile(folder / "large_strain_sphere.csv", ratioTable.view());

  auto surfaceTable = table(
    "# Sink of the surface of a neo-Hookean layer under a sphere, -u_z / R at deformed r / R.\n"
    "# W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2; bonded, frictionless, elements of R / "
    "20\n");
  surfaceTable << SurfaceTable::header() << '\n' << surfaces.str();
  replaceFile(folder / "surface_sphere.csv", surfaceTable.view());
}

// a cone has no length of its own: the ratio follows depth / thickness; the cap is felt near 0 only
void makeConeTable(
  const std::filesystem::path& folder, const std::stop_token& stop, const Tell& tell)
{
  constexpr std::array kDepthOverThickness{ 0.04, 0.08, 0.12, 0.16, 0.2, 0.24 };
  std::string notes;
  std::ostringstream forces;
  forces.precision(5);
  for (const double poisson : kConePoisson)
  {
    for (const double degrees : kConeDegrees)
    {
      if (stop.stop_requested())
      {
        return;
      }
      std::ostringstream name;
      name << "cone " << degrees << " deg, nu " << poisson;
      tell(name.str());
      const double angle = units::fromDegrees(degrees);
      const double base = 1.2 * kDepthOverThickness.back() * kConeThickness * std::tan(angle);
      Case study =
        layer(name.str(), BluntConeTip{ .halfAngle = angle, .tipRadius = kCap, .baseRadius = base },
          kConeThickness, poisson);
      for (const double depth : kDepthOverThickness)
      {
        study.depths.push_back(depth * kConeThickness);
      }
      const auto ratioOf = ratios(study, with(StrainEnergy::NeoHookean, study, stop), notes, stop);
      addRatios(forces, ratioOf.front(), kDepthOverThickness, degrees, poisson, ratioOf);
    }
  }
  if (stop.stop_requested())
  {
    return;
  }
  auto ratioTable =
    table("# Force of a neo-Hookean layer under a cone over that of the linear one, same mesh.\n"
          "# W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2; bonded, frictionless; 50 mm thick, "
          "tangent\n"
          "# cap of 0.3 mm; below 2 mm the ratio of 2 mm\n" +
      notes + "depth_over_thickness,half_angle_deg,poisson_ratio,force_ratio\n");
  ratioTable << forces.str();
  replaceFile(folder / "large_strain_cone.csv", ratioTable.view());
}

} // namespace

void makeShippedTables(
  const std::filesystem::path& folder, const std::stop_token& stop, const Tell& tell)
{
  makeExtentTables(folder, stop, tell);
  makeSphereTables(folder, stop, tell);
  makeConeTable(folder, stop, tell);
}

} // namespace palp::fem
