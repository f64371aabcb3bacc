#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace palp::report
{

/// A number, or a word.
using Cell = std::variant<double, std::string>;

/// Measured or computed numbers, written as NAME.csv; every figure is drawn from such tables.
struct Table
{
  std::string name;
  std::string caption;
  std::vector<std::string> columns; ///< each name ends in its unit
  std::vector<std::vector<Cell>> rows{};
  bool shown = true; ///< on the page; else linked only

  /// @param column  one of columns
  [[nodiscard]] std::size_t indexOf(const std::string& column) const;
};

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
  };

  std::string label;
  std::string table;                                        ///< of the same section
  std::string x;                                            ///< column
  std::string y;                                            ///< column
  std::vector<std::pair<std::string, std::string>> where{}; ///< column, cell
  Style style = Style::Line;
  int color = 0; ///< of the palette
};

/// A figure.
struct Chart
{
  std::string name; ///< of the file
  std::string caption;
  std::string bottom; ///< titles of the axes, with units
  std::string left;
  bool logBottom = false;
  bool logLeft = false;
  std::vector<Curve> curves{};
  std::string group{}; ///< charts of one group stand side by side and share the first one's legend
};

/// A figure that a part has drawn itself.
struct Picture
{
  std::string name; ///< of the SVG file
  std::string caption;
  std::string svg;
};

/// A figure or statement of the paper, and what came out here.
struct Claim
{
  std::string of;      ///< the paper: "Fig. 3", "Eq. (7)"
  std::string paper;   ///< what it says
  std::string here;    ///< what was found
  std::string verdict; ///< agreement, or the reason for the difference
};

/// What one part of the report found.
struct Section
{
  std::string name; ///< of the part and its JSON
  std::string title;
  std::vector<std::string> text{}; ///< paragraphs
  std::vector<Claim> claims{};
  std::vector<Table> tables{};
  std::vector<Chart> charts{};
  std::vector<Picture> pictures{};

  /// @param table  one of tables
  [[nodiscard]] const Table& operator[](const std::string& table) const;
};

/// The points of a curve; a pair with a number that is not finite is left out.
struct Points
{
  std::vector<double> x;
  std::vector<double> y;
};
[[nodiscard]] Points pointsOf(const Section& section, const Curve& curve);

/// A number for people: four significant digits.
[[nodiscard]] std::string shown(const Cell& cell);

/// Letters and digits of a name, joined by _, for files and anchors.
[[nodiscard]] std::string fileWord(const std::string& name);

[[nodiscard]] std::string csv(const Table& table);

[[nodiscard]] nlohmann::ordered_json toJson(const Section& section);

/// @throws nlohmann::json::exception  not what toJson() made
[[nodiscard]] Section sectionOf(const nlohmann::ordered_json& json);

} // namespace palp::report
