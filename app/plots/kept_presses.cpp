#include "app/plots/kept_presses.h"

#include "haptics/units.h"

#include <algorithm>

namespace palp
{
namespace
{

using units::toMillimeters;

constexpr const char* kDepth = "depth \u03b4 [mm]";

// the moments that are deeper than each before them
std::vector<CurvePoint> wayIn(const KeptPress& press)
{
  std::vector<CurvePoint> way{ { 0.0, 0.0 } };
  std::ranges::copy_if(press.curve, std::back_inserter(way),
    [&way](const CurvePoint& point) { return point.depth > way.back().depth; });
  return way;
}

// no deeper than the last
double forceAt(const std::vector<CurvePoint>& way, double depth)
{
  const auto after = std::ranges::lower_bound(way, depth, {}, &CurvePoint::depth);
  if (after == way.begin())
  {
    return after->force;
  }
  const CurvePoint& before = *(after - 1);
  const double part = (depth - before.depth) / (after->depth - before.depth);
  return before.force + part * (after->force - before.force);
}

void addCurve(Plot& plot, const KeptPress& press, std::span<const double> depths,
  std::span<const double> forces)
{
  const auto [color, style] = penOf(press);
  plot.addLine(press.summary.name, depths, forces, color, 2.0F, style);
}

} // namespace

PressPen penOf(const KeptPress& press) noexcept
{
  constexpr std::size_t kTaken = 2; // by what is recorded and by the model, in live charts
  constexpr std::size_t kFree = appearance::kCurves.size() - kTaken;
  const auto number = static_cast<std::size_t>(press.id - 1);
  return { appearance::curveColor(kTaken + number % kFree),
    static_cast<appearance::LineStyle>(1 + number / kFree % appearance::kLineStyles) };
}

std::vector<PressCurve> pressCurves(std::span<const KeptPress* const> presses)
{
  std::vector<PressCurve> curves;
  for (const KeptPress* press : presses)
  {
    const auto [color, style] = penOf(*press);
    PressCurve& curve = curves.emplace_back(
      PressCurve{ .name = press->summary.name, .color = color, .style = style });
    for (const CurvePoint& point : press->curve)
    {
      curve.depths.push_back(point.depth);
      curve.forces.push_back(point.force);
    }
  }
  return curves;
}

Plots pressForces(std::span<const KeptPress* const> presses)
{
  Plots plots;
  if (presses.empty())
  {
    return plots;
  }
  Plot& plot = *plots.emplace_back(std::make_unique<Plot>("force over depth", kDepth, "force [N]"));
  for (const KeptPress* press : presses)
  {
    std::vector<double> depths;
    std::vector<double> forces;
    for (const CurvePoint& point : press->curve)
    {
      depths.push_back(toMillimeters(point.depth));
      forces.push_back(point.force);
    }
    addCurve(plot, *press, depths, forces);
  }
  return plots;
}

Plots pressDifferences(std::span<const KeptPress* const> presses)
{
  Plots plots;
  if (presses.size() < 2)
  {
    return plots;
  }
  Plot& plot = *plots.emplace_back(std::make_unique<Plot>(
    "difference from " + presses.front()->summary.name, kDepth, "difference [N]"));
  const std::vector<CurvePoint> first = wayIn(*presses.front());
  for (const KeptPress* press : presses.subspan(1))
  {
    std::vector<double> depths;
    std::vector<double> differences;
    for (const CurvePoint& point : wayIn(*press))
    {
      if (point.depth <= first.back().depth)
      {
        depths.push_back(toMillimeters(point.depth));
        differences.push_back(point.force - forceAt(first, point.depth));
      }
    }
    addCurve(plot, *press, depths, differences);
  }
  return plots;
}

} // namespace palp
