#pragma once

#include "calibration/figures/table.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace palp::figures
{

/// Rows of a table as a curve: those whose cells are the given words, or begin with them and a
/// semicolon.
struct Curve
{
  enum class Style
  {
    Line,
    Dashed,
    Circles,
    Squares,
    Diamonds,
    Cells, ///< of a map: its color is a shade
  };

  std::string label;                                        ///< empty: not in the legend
  std::string table{};                                      ///< by name
  std::string x{};                                          ///< column
  std::string y{};                                          ///< column
  std::vector<std::pair<std::string, std::string>> where{}; ///< column, cell
  Style style = Style::Line;
  int color = 0; ///< of the palette; 0 is ink, 7 gray
};

/// Curves over the same axes, in the units that the titles of these name.
struct Figure
{
  std::string name; ///< of the file
  std::string caption;
  std::string bottom; ///< titles of the axes, with units
  std::string left;
  bool logBottom = false;
  bool logLeft = false;
  std::vector<Curve> curves{};
  std::string group{}; ///< figures of one group stand side by side and share the first one's legend
  double band = 0.0;   ///< what a hand does not notice, to either side of 0 [%]; 0: none
};

/// What the legend says of a figure's band.
[[nodiscard]] std::string bandLabel(const Figure& figure);

/// What a figure is drawn for.
enum class Layout
{
  Alone,  ///< a picture with its caption as title, and a legend
  OnPage, ///< part of a page, which has both
};

/// Points of a curve, in the units of its axes.
struct Points
{
  std::vector<double> x;
  std::vector<double> y;
};

/// The points of a curve; a pair with a number that is not finite is left out.
/// @throws Error  BadFile: no such table or column
[[nodiscard]] Points pointsOf(std::span<const Table> tables, const Curve& curve);

/// A table for the points of a figure, NAME_figure, empty.
[[nodiscard]] Table pointTable(const Figure& figure);

/// Adds a curve of points that no other table has: below those that the figure's own table holds,
/// told apart by a number.
///
/// @param curve  its label, style and color
/// @param own    as pointTable() made it
void addCurve(Figure& figure, Table& own, Curve curve, const Points& points);

} // namespace palp::figures
