#include "app/report/document.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace palp::report
{
namespace
{

using Json = nlohmann::ordered_json;

std::string textOf(const Cell& cell)
{
  const auto* number = std::get_if<double>(&cell);
  if (!number)
  {
    return std::get<std::string>(cell);
  }
  return std::isnan(*number) ? "" : shortest(*number);
}

// the words themselves, or the first of several that semicolons part
bool begins(const std::string& cell, const std::string& words)
{
  return cell == words || cell.starts_with(words + ";");
}

// JSON knows no infinity and no NaN
Json toJson(const Cell& cell)
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

Json toJson(const Table& table)
{
  Json rows = Json::array();
  for (const auto& row : table.rows)
  {
    Json cells = Json::array();
    std::ranges::transform(
      row, std::back_inserter(cells), [](const Cell& cell) { return toJson(cell); });
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

Json toJson(const Chart& chart)
{
  Json curves = Json::array();
  for (const Curve& curve : chart.curves)
  {
    curves.push_back({ { "label", curve.label }, { "table", curve.table }, { "x", curve.x },
      { "y", curve.y }, { "where", curve.where }, { "style", static_cast<int>(curve.style) },
      { "color", curve.color } });
  }
  return { { "name", chart.name }, { "caption", chart.caption }, { "bottom", chart.bottom },
    { "left", chart.left }, { "log_bottom", chart.logBottom }, { "log_left", chart.logLeft },
    { "group", chart.group }, { "curves", std::move(curves) } };
}

Chart chartOf(const Json& json)
{
  Chart chart{ .name = json.at("name"),
    .caption = json.at("caption"),
    .bottom = json.at("bottom"),
    .left = json.at("left"),
    .logBottom = json.at("log_bottom"),
    .logLeft = json.at("log_left"),
    .group = json.at("group") };
  for (const Json& curve : json.at("curves"))
  {
    chart.curves.push_back({ .label = curve.at("label"),
      .table = curve.at("table"),
      .x = curve.at("x"),
      .y = curve.at("y"),
      .where = curve.at("where"),
      .style = static_cast<Curve::Style>(curve.at("style").get<int>()),
      .color = curve.at("color") });
  }
  return chart;
}

} // namespace

std::size_t Table::indexOf(const std::string& column) const
{
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end())
  {
    throw Error(ErrorCode::BadFile, name + ".csv: no column " + column);
  }
  return static_cast<std::size_t>(found - columns.begin());
}

const Table& Section::operator[](const std::string& table) const
{
  const auto found = std::ranges::find(tables, table, &Table::name);
  if (found == tables.end())
  {
    throw Error(ErrorCode::BadFile, name + ": no table " + table);
  }
  return *found;
}

Points pointsOf(const Section& section, const Curve& curve)
{
  const Table& table = section[curve.table];
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

std::string shown(const Cell& cell)
{
  const auto* number = std::get_if<double>(&cell);
  if (!number)
  {
    return std::get<std::string>(cell);
  }
  if (!std::isfinite(*number))
  {
    return "\u2013";
  }
  if (*number == std::round(*number) && std::abs(*number) < 1e9)
  {
    return shortest(*number);
  }
  char text[32];
  const double size = std::abs(*number);
  const auto format =
    size >= 1e-3 && size < 1e7 ? std::chars_format::fixed : std::chars_format::scientific;
  const int digits = format == std::chars_format::scientific
    ? 2
    : std::clamp(3 - static_cast<int>(std::floor(std::log10(size))), 0, 5);
  const auto end = std::to_chars(text, text + sizeof text, *number, format, digits).ptr;
  return { text, end };
}

std::string fileWord(const std::string& name)
{
  std::string word;
  for (const char c : name)
  {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
    {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    else if (!word.empty() && word.back() != '_')
    {
      word += '_';
    }
  }
  return word;
}

namespace
{

// as RFC 4180 has it
std::string field(const std::string& text)
{
  if (text.find_first_of(",\"\n") == std::string::npos)
  {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text)
  {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + '"';
}

} // namespace

std::string csv(const Table& table)
{
  std::string text;
  const char* separator = "";
  for (const std::string& column : table.columns)
  {
    text.append(separator).append(field(column));
    separator = ",";
  }
  text += '\n';
  for (const auto& row : table.rows)
  {
    separator = "";
    for (const Cell& cell : row)
    {
      text.append(separator).append(field(textOf(cell)));
      separator = ",";
    }
    text += '\n';
  }
  return text;
}

Json toJson(const Section& section)
{
  Json tables = Json::array();
  for (const Table& table : section.tables)
  {
    tables.push_back(toJson(table));
  }
  Json charts = Json::array();
  for (const Chart& chart : section.charts)
  {
    charts.push_back(toJson(chart));
  }
  Json claims = Json::array();
  for (const Claim& claim : section.claims)
  {
    claims.push_back({ claim.of, claim.paper, claim.here, claim.verdict });
  }
  Json pictures = Json::array();
  for (const Picture& picture : section.pictures)
  {
    pictures.push_back({ picture.name, picture.caption, picture.svg });
  }
  return { { "name", section.name }, { "title", section.title }, { "text", section.text },
    { "claims", std::move(claims) }, { "tables", std::move(tables) },
    { "charts", std::move(charts) }, { "pictures", std::move(pictures) } };
}

Section sectionOf(const Json& json)
{
  Section section{ .name = json.at("name"), .title = json.at("title"), .text = json.at("text") };
  for (const Json& picture : json.at("pictures"))
  {
    section.pictures.push_back({ picture.at(0), picture.at(1), picture.at(2) });
  }
  for (const Json& claim : json.at("claims"))
  {
    section.claims.push_back({ claim.at(0), claim.at(1), claim.at(2), claim.at(3) });
  }
  for (const Json& table : json.at("tables"))
  {
    section.tables.push_back(tableOf(table));
  }
  for (const Json& chart : json.at("charts"))
  {
    section.charts.push_back(chartOf(chart));
  }
  return section;
}

} // namespace palp::report
