#include "calibration/figures/figure_json.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

namespace palp::figures
{
namespace
{

using Json = nlohmann::ordered_json;

// JSON knows no infinity and no NaN
Json jsonOf(const Cell& cell)
{
  const auto* number = std::get_if<double>(&cell);
  return number ? Json(*number) : Json(std::get<std::string>(cell));
}

Cell cellOf(const Json& json)
{
  if (json.is_string())
  {
    return json.get<std::string>();
  }
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

} // namespace

Json toJson(const Table& table)
{
  Json rows = Json::array();
  for (const auto& row : table.rows)
  {
    Json cells = Json::array();
    std::ranges::transform(row, std::back_inserter(cells), jsonOf);
    rows.push_back(std::move(cells));
  }
  return { { "name", table.name }, { "caption", table.caption }, { "columns", table.columns },
    { "rows", std::move(rows) }, { "shown", table.shown } };
}

Table tableOf(const Json& json)
{
  Table table{ .name = json.at("name"),
    .caption = json.at("caption"),
    .columns = json.at("columns"),
    .shown = json.at("shown") };
  for (const Json& row : json.at("rows"))
  {
    auto& cells = table.rows.emplace_back();
    std::ranges::transform(row, std::back_inserter(cells), cellOf);
  }
  return table;
}

Json toJson(const Figure& figure)
{
  Json curves = Json::array();
  for (const Curve& curve : figure.curves)
  {
    curves.push_back({ { "label", curve.label }, { "table", curve.table }, { "x", curve.x },
      { "y", curve.y }, { "where", curve.where }, { "style", static_cast<int>(curve.style) },
      { "color", curve.color } });
  }
  return { { "name", figure.name }, { "caption", figure.caption }, { "bottom", figure.bottom },
    { "left", figure.left }, { "log_bottom", figure.logBottom }, { "log_left", figure.logLeft },
    { "group", figure.group }, { "band", figure.band }, { "curves", std::move(curves) } };
}

Figure figureOf(const Json& json)
{
  Figure figure{ .name = json.at("name"),
    .caption = json.at("caption"),
    .bottom = json.at("bottom"),
    .left = json.at("left"),
    .logBottom = json.at("log_bottom"),
    .logLeft = json.at("log_left"),
    .group = json.at("group"),
    .band = json.value("band", 0.0) };
  for (const Json& curve : json.at("curves"))
  {
    figure.curves.push_back({ .label = curve.at("label"),
      .table = curve.at("table"),
      .x = curve.at("x"),
      .y = curve.at("y"),
      .where = curve.at("where"),
      .style = static_cast<Curve::Style>(curve.at("style").get<int>()),
      .color = curve.at("color") });
  }
  return figure;
}

} // namespace palp::figures
