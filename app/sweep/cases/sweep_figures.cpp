#include "app/sweep/cases/sweep_figures.h"

#include "app/sweep/cases/table_writer.h"
#include "calibration/figures/palette.h"
#include "haptics/error.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace palp
{
namespace
{

constexpr std::size_t kColors = 8;                  // of the palette
using Rows = std::vector<std::vector<std::string>>; // the titles first

// numbers where they are drawn, else words, by which rows are chosen
figures::Table tableOf(const SweepPlot& plot, const Rows& rows)
{
  figures::Table table{ .name = plot.name, .caption = plot.title, .columns = rows.front() };
  for (auto row = rows.begin() + 1; row != rows.end(); ++row)
  {
    auto& cells = table.rows.emplace_back();
    for (std::size_t i = 0; i < row->size(); ++i)
    {
      const std::string& column = table.columns[i];
      const bool drawn = column == plot.x || column == plot.y || column == plot.colors;
      const auto number = drawn ? numberOf((*row)[i]) : std::nullopt;
      cells.push_back(number ? figures::Cell(*number) : figures::Cell((*row)[i]));
    }
  }
  return table;
}

figures::Figure figureOf(const SweepPlot& plot, const figures::Table& table)
{
  figures::Figure figure{
    .name = plot.name, .caption = plot.title, .bottom = plot.x, .left = plot.y
  };
  figures::Curve curve{ .label = "", .table = plot.name, .x = plot.x, .y = plot.y };
  curve.where.assign(plot.where.begin(), plot.where.end());
  if (plot.curves.empty())
  {
    figure.curves.push_back(curve);
    return figure;
  }
  const std::size_t column = table.indexOf(plot.curves);
  std::vector<std::string> seen;
  for (const auto& row : table.rows)
  {
    const std::string value = figures::textOf(row[column]);
    if (std::ranges::find(seen, value) == seen.end())
    {
      seen.push_back(value);
      figures::Curve& one = figure.curves.emplace_back(curve);
      one.label = value;
      one.where.emplace_back(plot.curves, value);
      // the ninth looks like the first, but dashed
      one.color = static_cast<int>((seen.size() - 1) % kColors);
      one.style =
        seen.size() > kColors ? figures::Curve::Style::Dashed : figures::Curve::Style::Line;
    }
  }
  return figure;
}

// the least and the largest of a column's numbers; none: the same twice
std::pair<double, double> rangeOf(const std::vector<double>& values)
{
  const auto [least, most] = std::ranges::minmax_element(values);
  return values.empty() ? std::pair(0.0, 0.0) : std::pair(*least, *most);
}

std::string classLabel(double from, double to)
{
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.3g to %.3g", from, to);
  return text.data();
}

// as many classes of equal width as there are shades, each of which is a curve of cells
figures::Figure mapOf(const SweepPlot& plot, const figures::Table& table, figures::Table& own)
{
  figures::Curve all{ .label = "", .table = plot.name, .x = plot.x, .y = plot.colors };
  all.where.assign(plot.where.begin(), plot.where.end());
  const figures::Points values = figures::pointsOf({ &table, 1 }, all);
  all.x = plot.colors;
  all.y = plot.y;
  const figures::Points heights = figures::pointsOf({ &table, 1 }, all);
  if (heights.x != values.y)
  {
    throw Error(ErrorCode::BadFile,
      plot.name + ": " + plot.x + " or " + plot.y +
        " is no number in some rows; choose others by \"where\"");
  }
  const auto [least, most] = rangeOf(values.y);
  const double width = (most - least) / figures::kShades;
  std::array<figures::Points, figures::kShades> classes;
  for (std::size_t i = 0; i < values.y.size(); ++i)
  {
    const int above = width > 0.0 ? static_cast<int>((values.y[i] - least) / width) : 0;
    figures::Points& one = classes[static_cast<std::size_t>(std::min(above, figures::kShades - 1))];
    one.x.push_back(values.x[i]);
    one.y.push_back(heights.y[i]);
  }
  figures::Figure figure{
    .name = plot.name, .caption = plot.title, .bottom = plot.x, .left = plot.y
  };
  own = figures::pointTable(figure);
  for (int k = 0; k < figures::kShades; ++k)
  {
    const figures::Curve cells{ .label = classLabel(least + k * width, least + (k + 1) * width),
      .style = figures::Curve::Style::Cells,
      .color = k };
    figures::addCurve(figure, own, cells, classes[static_cast<std::size_t>(k)]);
  }
  return figure;
}

} // namespace

SweepFigures sweepFigures(Manifest& manifest, const MergeOptions& options)
{
  const Rows rows = readResults(manifest, options);
  SweepFigures drawn;
  for (const SweepPlot& plot : manifest.head().plots)
  {
    drawn.tables.push_back(tableOf(plot, rows));
    if (plot.colors.empty())
    {
      drawn.figures.push_back(figureOf(plot, drawn.tables.back()));
      continue;
    }
    figures::Table own;
    drawn.figures.push_back(mapOf(plot, drawn.tables.back(), own));
    drawn.tables.push_back(std::move(own));
  }
  return drawn;
}

} // namespace palp
