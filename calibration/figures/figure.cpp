#include "calibration/figures/figure.h"

#include "haptics/error.h"

#include <algorithm>
#include <cmath>

namespace palp::figures
{
namespace
{

constexpr const char* kNumber = "number";

// the words themselves, or the first of several that semicolons part
bool begins(const std::string& cell, const std::string& words)
{
  return cell == words || cell.starts_with(words + ";");
}

const Table& tableNamed(std::span<const Table> tables, const std::string& name)
{
  const auto found = std::ranges::find(tables, name, &Table::name);
  if (found == tables.end())
  {
    throw Error(ErrorCode::BadFile, "no table " + name);
  }
  return *found;
}

} // namespace

std::string bandLabel(const Figure& figure)
{
  return "less than a hand notices, " + std::to_string(std::lround(figure.band)) + " %";
}

Points pointsOf(std::span<const Table> tables, const Curve& curve)
{
  const Table& table = tableNamed(tables, curve.table);
  const std::size_t x = table.indexOf(curve.x);
  const std::size_t y = table.indexOf(curve.y);
  Points points;
  for (const auto& row : table.rows)
  {
    const bool wanted = std::ranges::all_of(curve.where,
      [&](const auto& condition)
      { return begins(textOf(row[table.indexOf(condition.first)]), condition.second); });
    const auto* a = std::get_if<double>(&row[x]);
    const auto* b = std::get_if<double>(&row[y]);
    if (wanted && a && b && std::isfinite(*a) && std::isfinite(*b))
    {
      points.x.push_back(*a);
      points.y.push_back(*b);
    }
  }
  return points;
}

Table pointTable(const Figure& figure)
{
  return { .name = figure.name + "_figure",
    .caption = figure.caption,
    .columns = { kNumber, "curve", figure.bottom, figure.left },
    .shown = false };
}

void addCurve(Figure& figure, Table& own, Curve curve, const Points& points)
{
  const std::size_t number = figure.curves.size() + 1;
  for (std::size_t i = 0; i < points.x.size(); ++i)
  {
    own.rows.push_back({ static_cast<double>(number), curve.label, points.x[i], points.y[i] });
  }
  curve.table = own.name;
  curve.x = figure.bottom;
  curve.y = figure.left;
  curve.where = { { kNumber, std::to_string(number) } };
  figure.curves.push_back(std::move(curve));
}

} // namespace palp::figures
