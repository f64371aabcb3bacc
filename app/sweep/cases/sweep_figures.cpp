#include "app/sweep/cases/sweep_figures.h"

#include "app/sweep/cases/table_writer.h"
#include "calibration/figures/palette.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

namespace palp
{
namespace
{

constexpr std::size_t kColors = 8; // of the palette
// of the first eight curves, of the next eight ...; kMarks where they have one point each
constexpr std::array kMarks{ figures::Curve::Style::Circles, figures::Curve::Style::Squares,
  figures::Curve::Style::Diamonds };
constexpr std::array kStyles{ figures::Curve::Style::Line, figures::Curve::Style::Dashed,
  figures::Curve::Style::Circles, figures::Curve::Style::Squares, figures::Curve::Style::Diamonds };
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
      const bool drawn =
        column == plot.x || column == plot.y || column == plot.colors || column == kCaseColumn;
      const auto number = drawn ? numberOf((*row)[i]) : std::nullopt;
      cells.push_back(number ? figures::Cell(*number) : figures::Cell((*row)[i]));
    }
  }
  return table;
}

[[noreturn]] void refusePlot(const SweepPlot& plot, const std::string& what)
{
  throw Error(ErrorCode::BadFile, "plot " + inQuotes(plot.name) + ": " + what);
}

void refuseMissing(const SweepPlot& plot, const std::vector<std::string>& columns)
{
  std::vector<std::string> needed{ plot.x, plot.y, plot.curves, plot.colors };
  for (const auto& [column, value] : plot.where)
  {
    needed.push_back(column);
  }
  for (const std::string& column : needed)
  {
    if (!column.empty() && std::ranges::find(columns, column) == columns.end())
    {
      refusePlot(plot,
        "there is no column " + inQuotes(column) + " but " + listed(std::span(columns).subspan(1)) +
          "; change the plot and plan again, which keeps what is finished");
    }
  }
}

constexpr const char* kTellApart =
  R"(; tell them apart by "curves" or "where", or merge one row of each case by --largest COLUMN)";

// a line that leads from one case to another is of no press, unless it goes on in x
void refuseMixed(const SweepPlot& plot, const figures::Table& table, figures::Curve curve)
{
  const std::vector<double> x = figures::pointsOf({ &table, 1 }, curve).x;
  curve.y = kCaseColumn;
  const std::vector<double> cases = figures::pointsOf({ &table, 1 }, curve).y;
  const bool isOfOne = std::ranges::adjacent_find(cases, std::not_equal_to()) == cases.end();
  const bool goesOn = std::ranges::adjacent_find(x, std::greater_equal()) == x.end() ||
    std::ranges::adjacent_find(x, std::less_equal()) == x.end();
  if (!isOfOne && !goesOn)
  {
    refusePlot(
      plot, "a curve would lead through the rows of several cases" + std::string(kTellApart));
  }
}

figures::Figure figureOf(
  const SweepPlot& plot, const figures::Table& table, const std::vector<SweepColumn>& columns)
{
  figures::Figure figure{
    .name = plot.name, .caption = plot.title, .bottom = plot.x, .left = plot.y
  };
  figures::Curve curve{ .label = "", .table = plot.name, .x = plot.x, .y = plot.y };
  curve.where.assign(plot.where.begin(), plot.where.end());
  if (plot.curves.empty())
  {
    curve.style = figures::Curve::Style::Circles; // a line would go from one case to another
    figure.curves.push_back(curve);
    return figure;
  }
  const std::size_t column = table.indexOf(plot.curves);
  std::vector<std::string> seen;
  std::string unit;
  for (const SweepColumn& varied : columns)
  {
    unit = varied.title() == plot.curves && !varied.unit.empty() ? " " + varied.unit : unit;
  }
  for (const auto& row : table.rows)
  {
    const std::string value = figures::textOf(row[column]);
    if (std::ranges::find(seen, value) == seen.end())
    {
      seen.push_back(value);
      figures::Curve& one = figure.curves.emplace_back(curve);
      one.label = value + unit;
      one.where.emplace_back(plot.curves, value);
      one.color = static_cast<int>((seen.size() - 1) % kColors);
      const std::size_t round = (seen.size() - 1) / kColors;
      one.style = kStyles[round % kStyles.size()];
      if (figures::pointsOf({ &table, 1 }, one).x.size() == 1) // is no line
      {
        one.style = kMarks[round % kMarks.size()];
      }
      refuseMixed(plot, table, one);
    }
  }
  if (seen.size() > kColors * kStyles.size())
  {
    refusePlot(plot,
      "would have " + std::to_string(seen.size()) + " curves, of which " +
        std::to_string(kColors * kStyles.size()) +
        R"( can be told apart; choose some by "where", or draw a map by "colors")");
  }
  return figure;
}

// with as many decimals as tell a class from the next
std::string classLabel(double from, double to)
{
  constexpr int kMostDecimals = 9;
  const double decimals = to > from ? std::ceil(1.0 - std::log10(to - from)) : 2.0;
  const int shown = static_cast<int>(std::clamp(decimals, 0.0, 1.0 + kMostDecimals));
  std::array<char, 96> text{};
  const char* format = shown > kMostDecimals ? "%.*g to %.*g" : "%.*f to %.*f";
  std::snprintf(text.data(), text.size(), format, shown, from, shown, to);
  return text.data();
}

void refuseEmpty(const SweepPlot& plot)
{
  refusePlot(plot,
    "no row has numbers in " + inQuotes(plot.x) + " and " + inQuotes(plot.y) +
      (plot.colors.empty() ? "" : " and " + inQuotes(plot.colors)) +
      (plot.where.empty() ? "" : " and is one of its \"where\"") +
      "; change the plot and plan again, which keeps what is finished");
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
    refusePlot(
      plot, plot.x + " or " + plot.y + " is no number in some rows; choose others by \"where\"");
  }
  std::set<std::pair<double, double>> places;
  for (std::size_t i = 0; i < values.x.size(); ++i)
  {
    if (!places.emplace(values.x[i], heights.y[i]).second)
    {
      refusePlot(plot,
        "several rows would be at one place of the map; choose one of them by \"where\", or by "
        "--largest COLUMN where they are of one case");
    }
  }
  if (values.y.empty())
  {
    refuseEmpty(plot);
  }
  const auto [least, most] = std::ranges::minmax(values.y);
  const double width = (most - least) / figures::kShades;
  std::array<figures::Points, figures::kShades> classes;
  for (std::size_t i = 0; i < values.y.size(); ++i)
  {
    const int above = width > 0.0 ? static_cast<int>((values.y[i] - least) / width) : 0;
    figures::Points& one = classes[static_cast<std::size_t>(std::min(above, figures::kShades - 1))];
    one.x.push_back(values.x[i]);
    one.y.push_back(heights.y[i]);
  }
  figures::Figure figure{ .name = plot.name,
    .caption = plot.title.empty() ? plot.colors : plot.title + ": " + plot.colors,
    .bottom = plot.x,
    .left = plot.y };
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

void addPlot(SweepFigures& drawn, const SweepPlot& plot, const Rows& rows,
  const std::vector<SweepColumn>& columns)
{
  refuseMissing(plot, rows.front());
  std::vector<figures::Table> tables{ tableOf(plot, rows) };
  figures::Figure figure;
  if (plot.colors.empty())
  {
    figure = figureOf(plot, tables.front(), columns);
    if (std::ranges::all_of(figure.curves,
          [&](const figures::Curve& curve) { return figures::pointsOf(tables, curve).x.empty(); }))
    {
      refuseEmpty(plot);
    }
  }
  else
  {
    figures::Table own;
    figure = mapOf(plot, tables.front(), own);
    tables.push_back(std::move(own));
  }
  drawn.figures.push_back(std::move(figure));
  std::ranges::move(tables, std::back_inserter(drawn.tables));
}

} // namespace

SweepFigures sweepFigures(Manifest& manifest, const MergeOptions& options)
{
  const Rows rows = readResults(manifest, options);
  SweepFigures drawn;
  for (const SweepPlot& plot : manifest.head().plots)
  {
    try
    {
      addPlot(drawn, plot, rows, manifest.head().columns);
    }
    catch (const Error& error)
    {
      drawn.refused.emplace_back(error.what());
    }
  }
  return drawn;
}

} // namespace palp
