#include "app/report/methods.h"
#include "app/report/pareto.h"
#include "app/report/parts.h"
#include "haptics/files/csv_text.h"
#include "haptics/numerics/statistics.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>

namespace palp::report
{
namespace
{

using namespace units::literals;
using units::toMillimeters;

constexpr double kFarthest = 45.0_mm; // from the axis; the block ends at 50 mm

struct Off
{
  double largest = 0.0;
  double squares = 0.0; // over the length [m^3]
  double length = 0.0;
};

// each point counts for half the way to its neighbors
void add(Off& off, Drawn drawn, const ReferenceSurface& reference)
{
  std::ranges::sort(drawn);
  for (std::size_t i = 1; i + 1 < drawn.size(); ++i)
  {
    const auto [radius, sink] = drawn[i];
    if (radius > kFarthest)
    {
      break;
    }
    const double error = std::abs(sink - reference.sinkAt(radius));
    const double width = 0.5 * (drawn[i + 1].first - drawn[i - 1].first);
    off.largest = std::max(off.largest, error);
    off.squares += width * error * error;
    off.length += width;
  }
}

Section start()
{
  Section section;
  section.tables = { Table{ .name = "surface_summary",
                       .caption = "RMS error of the drawn surface in each regime [mm], and what "
                                  "each method leaves out.",
                       .columns = { "press", "method", "setting", "time_us", "shallow_rms_mm",
                         "jnd_rms_mm", "deep_rms_mm", "leaves_out" } },
    Table{ .name = "surface_error_vs_time",
      .caption = "Error of the surface of every method, setting and regime.",
      .columns = { "method", "setting", "regime", "time_us", "error_max_mm", "error_rms_mm" },
      .shown = false },
    Table{ .name = "surface_profiles",
      .caption = "Surfaces: height over the distance from the axis.",
      .columns = { "press", "method", "depth_mm", "radius_mm", "height_mm" },
      .shown = false } };
  return section;
}

void addTrial(Section& section, const BlockPress& press,
  std::span<const ReferenceSurface> references, const SurfaceTrial& trial)
{
  std::vector<Cell> line{ press.name, trial.method, trial.setting };
  std::vector<double> all;
  for (const Regime& regime : kRegimes)
  {
    Off off;
    std::vector<double> times;
    for (std::size_t i = 0; i < references.size(); ++i)
    {
      if (isIn(regime, references[i].depth, press.size))
      {
        add(off, trial.surfaces[i], references[i]);
        times.insert(times.end(), trial.times[i].begin(), trial.times[i].end());
      }
    }
    const double rms = toMillimeters(std::sqrt(off.squares / off.length));
    line.emplace_back(rms); // no number where there is no reference
    if (!times.empty())
    {
      section.tables[1].rows.push_back({ trial.method, press.name + "; " + trial.setting,
        regime.name, statisticsOf(times).median, toMillimeters(off.largest), rms });
      all.insert(all.end(), times.begin(), times.end());
    }
  }
  line.insert(line.begin() + 3, statisticsOf(all).median);
  line.emplace_back(trial.leavesOut);
  section.tables[0].rows.push_back(std::move(line));
}

void addProfile(Table& table, const BlockPress& press, const std::string& method, double depth,
  const Drawn& drawn)
{
  for (const auto& [radius, sink] : drawn)
  {
    if (radius <= kFarthest)
    {
      table.rows.push_back(
        { press.name, method, toMillimeters(depth), toMillimeters(radius), -toMillimeters(sink) });
    }
  }
}

// the last reference at the JND limit and the last one to R
std::vector<double> profileDepths(const BlockPress& press)
{
  std::vector<double> depths;
  for (const Regime& regime : { kRegimes[1], kRegimes[2] })
  {
    double last = 0.0;
    for (const ReferenceSurface& reference : referenceSurfaces(press))
    {
      last = isIn(regime, reference.depth, press.size) ? reference.depth : last;
    }
    depths.push_back(last);
  }
  return depths;
}

using Style = Curve::Style;

struct SurfaceMark
{
  const char* method;
  Style point;
  Style line;
  int color;
};
constexpr std::array kSurfaceMarks{ SurfaceMark{ "paper Bezier", Style::Circles, Style::Line, 2 },
  SurfaceMark{ "fitted Bezier", Style::Circles, Style::Line, 1 },
  SurfaceMark{ "finite elements", Style::Diamonds, Style::Dashed, 0 } };

using Words = std::vector<std::pair<std::string, std::string>>; // column, cell

Figure errorFigure(const BlockPress& press, const Regime& regime)
{
  Figure figure{ .name = "surface_error_" + fileWord(press.name) + "_" + fileWord(regime.name),
    .caption = regime.name,
    .bottom = "time of one picture [\u00b5s]",
    .left = "RMS error of the surface [mm]",
    .logBottom = true,
    .logLeft = true,
    .group = "RMS error of the surface against the time of one picture, " + press.name +
      ". Lower and further left is better." };
  const auto add = [&](const char* label, const char* table, Words where, Style style, int color)
  {
    where.emplace_back("regime", regime.name);
    figure.curves.push_back(
      { label, table, "time_us", "error_rms_mm", std::move(where), style, color });
  };
  for (const SurfaceMark& mark : kSurfaceMarks)
  {
    add(mark.method, "surface_error_vs_time",
      { { "method", mark.method }, { "setting", press.name } }, mark.point, mark.color);
  }
  add("Pareto front", "surface_pareto_front", { { "front", press.name } }, Style::Dashed, 0);
  return figure;
}

Figure profileFigure(const BlockPress& press, double depth)
{
  const std::string depthMm = shortest(toMillimeters(depth)); // as the table's cells
  Figure figure{ .name =
                   "surface_profiles_" + fileWord(press.name) + "_" + fileWord(depthMm) + "mm",
    .caption = depthMm + " mm deep",
    .bottom = "distance from the axis [mm]",
    .left = "height [mm]",
    .group = "The surface under " + press.name +
      ". The paper's curve meets the undeformed surface at R_d, where the tissue is still 0.5 mm "
      "deep; at a depth of R its Eq. (3) has contact up to the equator and leaves no ring. The "
      "fitted curve follows the tissue to the edge of the block." };
  const auto add = [&](const char* label, const char* method, Style style, int color)
  {
    const Words where{ { "press", press.name }, { "method", method }, { "depth_mm", depthMm } };
    figure.curves.push_back(
      { label, "surface_profiles", "radius_mm", "height_mm", where, style, color });
  };
  add("independent elements", "reference", Style::Circles, 7);
  for (const SurfaceMark& mark : kSurfaceMarks)
  {
    add(mark.method, mark.method, mark.line, mark.color);
  }
  return figure;
}

void addSurfaceFigures(Section& section, const BlockPress& press)
{
  for (const Regime& regime : kRegimes)
  {
    section.figures.push_back(errorFigure(press, regime));
  }
  for (const double depth : profileDepths(press))
  {
    section.figures.push_back(profileFigure(press, depth));
  }
}

void measurePress(
  Section& section, const BlockPress& press, const Effort& effort, double begin, double fraction)
{
  const auto references = referenceSurfaces(press);
  const auto depths = profileDepths(press);
  const auto isShown = [&](const ReferenceSurface& one)
  { return std::ranges::find(depths, one.depth) != depths.end(); };
  for (const ReferenceSurface& one : references)
  {
    if (!isShown(one))
    {
      continue;
    }
    Drawn points; // every sixth, to be seen apart
    for (std::size_t i = 0; i < one.radius.size(); i += 6)
    {
      points.emplace_back(one.radius[i], one.sink[i]);
    }
    addProfile(section.tables[2], press, "reference", one.depth, points);
  }
  const auto keep = [&](const SurfaceTrial& trial, bool profile)
  {
    addTrial(section, press, references, trial);
    for (std::size_t i = 0; profile && i < references.size(); ++i)
    {
      if (isShown(references[i]))
      {
        addProfile(section.tables[2], press, trial.method, references[i].depth, trial.surfaces[i]);
      }
    }
  };
  keep(tryDent(press, references, false, effort), true);
  keep(tryDent(press, references, true, effort), true);
  for (std::size_t i = 0; i < kResolutions.size(); ++i)
  {
    keep(
      tryElementSurface(press, references, kResolutions[i], effort), i + 1 == kResolutions.size());
    effort.reached(begin + fraction * static_cast<double>(i + 1) / kResolutions.size());
  }
  addSurfaceFigures(section, press);
}

} // namespace

Section surfaceAgainstTime(const Effort& effort)
{
  Section section = start();
  section.text = {
    "Reference: the neo-Hookean surfaces of the same independent program. The error is vertical, "
    "over the radius from the axis to 45 mm, each point by the length it stands for; only depths "
    "at which that program wrote its surface count (2.5, 5, 7.5 and 10 mm), so that the smaller "
    "sphere has none in the shallow regime.",
    "Time is that of one picture: for the Bezier surfaces contact, force, dent and normals of " +
      std::to_string(kDrawnPoints) +
      " vertices; for finite elements the step from the depth half a millimeter before."
  };
  const std::span all(presses());
  const auto wanted = effort.quick ? all.subspan(1, 1) : all.first(2);
  const double fraction = 1.0 / static_cast<double>(wanted.size());
  double begin = 0.0;
  for (const BlockPress& press : wanted)
  {
    measurePress(section, press, effort, begin, fraction);
    begin += fraction;
  }
  Table front{ .name = "surface_pareto_front",
    .caption = "The Pareto fronts: no other surface is both faster and more accurate.",
    .columns = { "front", "method", "setting", "regime", "time_us", "error_rms_mm" },
    .shown = false };
  for (const BlockPress& press : wanted)
  {
    addParetoFront(front, press.name, section.tables[1], press.name, "");
  }
  section.tables.insert(section.tables.begin() + 1, std::move(front));
  // a regime without a depth of the references
  std::erase_if(section.figures,
    [&](const Figure& figure)
    {
      return std::ranges::all_of(figure.curves,
        [&](const Curve& curve) { return pointsOf(section.tables, curve).x.empty(); });
    });
  return section;
}

} // namespace palp::report
