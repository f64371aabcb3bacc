#include "calibration/experiments/experiment_parts.h"

#include "calibration/fem/mesh.h"
#include "haptics/error.h"
#include "haptics/files/fixed_text.h"
#include "haptics/force/validity.h"

#include <algorithm>
#include <cmath>

namespace palp::fem
{

std::string csv(const Experiment& experiment)
{
  constexpr int kDigits = 7;
  return "# " + experiment.finding + '\n' + figures::csv(experiment.numbers, kDigits);
}

namespace parts
{

using namespace units::literals;
using units::toMillimeters;

namespace
{
constexpr const char* kDepthColumn = "depth_mm";
}

std::vector<double> depthSteps(double step, double last, Resolution resolution)
{
  const double width = resolution == Resolution::Quick ? 2.0 * step : step;
  std::vector<double> depths;
  for (int i = 1; i * width < last + 0.5 * step; ++i)
  {
    depths.push_back(i * width);
  }
  return depths;
}

Tip tool(bool sphere, double radius)
{
  return sphere ? Tip{ SphereTip{ radius } }
                : withCap(ConeTip{ .halfAngle = 45.0_deg, .baseRadius = radius }, 0.3_mm);
}

double elementSize(const Tip& tip, Resolution resolution)
{
  const double full = std::holds_alternative<SphereTip>(tip) ? 0.1 * baseRadius(tip) : 0.5_mm;
  return resolution == Resolution::Quick ? 2.0 * full : full;
}

Case paperBlock(const Tip& tip, double height, StrainEnergy energy, std::vector<double> depths,
  Resolution resolution)
{
  return { .name = "block",
    .height = height,
    .tip = tip,
    .material = kTissue,
    .energy = energy,
    .depths = std::move(depths),
    .elementSize = elementSize(tip, resolution) };
}

std::vector<double> forcesOn(const Body& body, const Tip& tip, StrainEnergy energy,
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

double largest(const std::vector<double>& values)
{
  double most = 0.0;
  for (const double value : values)
  {
    most = value > most ? value : most;
  }
  return most;
}

double passing(const std::vector<double>& depths, const std::vector<double>& errors, double limit)
{
  double last = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < depths.size() && !std::isnan(errors[i]); ++i)
  {
    const double error = std::abs(errors[i]);
    if (error > limit)
    {
      return last + (depths[i] - last) * (limit - before) / (error - before);
    }
    last = depths[i];
    before = error;
  }
  return std::numeric_limits<double>::infinity();
}

std::string passesAt(const std::vector<double>& depths, const std::vector<double>& errors)
{
  const double at = passing(depths, errors, Validity::kJustNoticeable);
  if (std::isfinite(at))
  {
    return "at " + fixed(toMillimeters(at), 1) + " mm";
  }
  const auto known = std::ranges::find_if(errors, [](double error) { return std::isnan(error); });
  const double last =
    known == errors.begin() ? 0.0 : depths[static_cast<std::size_t>(known - errors.begin()) - 1];
  return "nowhere to " + fixed(toMillimeters(last), 1) + " mm";
}

Experiment experimentOf(std::string name, std::vector<std::string> columns)
{
  return { .numbers = { .name = std::move(name),
             .caption = "All numbers of the experiment.",
             .columns = std::move(columns),
             .shown = false } };
}

Experiment overDepth(std::string name, const std::vector<double>& depths)
{
  Experiment experiment = experimentOf(std::move(name), { kDepthColumn });
  for (const double depth : depths)
  {
    experiment.numbers.rows.push_back({ toMillimeters(depth) });
  }
  return experiment;
}

void addColumn(Experiment& experiment, std::string name, const std::vector<double>& values)
{
  experiment.numbers.columns.push_back(std::move(name));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    experiment.numbers.rows[i].emplace_back(values[i]);
  }
}

void addFigure(Experiment& experiment, Figure figure)
{
  experiment.points.push_back(figures::pointTable(figure));
  experiment.figures.push_back(std::move(figure));
}

void addCurve(Experiment& experiment, Curve curve, const Points& points)
{
  figures::addCurve(experiment.figures.back(), experiment.points.back(), std::move(curve), points);
}

Points pointsOf(const Experiment& experiment, const std::string& column)
{
  const Table& numbers = experiment.numbers;
  const std::string& first = numbers.columns.front();
  Points points = figures::pointsOf(
    std::span(&numbers, 1), { .label = {}, .table = numbers.name, .x = first, .y = column });
  if (first == kDepthColumn)
  {
    points.x.insert(points.x.begin(), 0.0);
    points.y.insert(points.y.begin(), 0.0);
  }
  return points;
}

} // namespace parts
} // namespace palp::fem
