#include "app/report/stability_map.h"

#include "haptics/files/csv_text.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace palp
{
namespace
{

constexpr int kCell = 44;    // [px]
constexpr int kRow = 22;     // [px]
constexpr int kLabels = 215; // width of the names of the rows [px]
constexpr int kHead = 92;    // above the cells [px]
constexpr int kFoot = 76;    // below them [px]

// the colors differ in lightness too, for those who see few of them
const char* colorOf(StabilityOutcome outcome)
{
  switch (outcome)
  {
    case StabilityOutcome::Stable:
      return "#8fd19e";
    case StabilityOutcome::Limited:
      return "#cfe8a9";
    case StabilityOutcome::Refused:
      return "#b9c0c8";
    case StabilityOutcome::Unstable:
      return "#a61c2e";
  }
  return "none";
}

double modulusOf(const StabilityCase& what)
{
  return what.material ? what.material->youngModulus : std::numeric_limits<double>::infinity();
}

std::string columnName(double modulus)
{
  struct Unit
  {
    double size;
    const char* name;
  };
  for (const auto& [size, name] : { Unit{ 1e9, "GPa" }, Unit{ 1e6, "MPa" }, Unit{ 1e3, "kPa" } })
  {
    if (modulus >= size && std::isfinite(modulus))
    {
      return shortest(modulus / size) + " " + name;
    }
  }
  return "rigid";
}

std::string rowName(const StabilityCase& what)
{
  if (what.name != "material")
  {
    return what.name;
  }
  return "period " + shortest(units::toMilliseconds(what.loop.period)) + " ms";
}

void text(std::ostream& out, int x, int y, const std::string& words, const char* more = "")
{
  out << R"(<text x=")" << x << R"(" y=")" << y << R"(" )" << more << ">" << words << "</text>\n";
}

using Cells = std::map<std::pair<std::string, double>, StabilityOutcome>;

Cells worstOf(std::span<const JudgedCase> cases, bool chain)
{
  Cells cells;
  for (const JudgedCase& one : cases)
  {
    const StabilityOutcome outcome = (chain ? one.chain : one.bare).outcome;
    const auto [cell, isNew] =
      cells.try_emplace({ rowName(one.what), modulusOf(one.what) }, outcome);
    cell->second = std::max(cell->second, outcome);
  }
  return cells;
}

// the cells of one loop, under the names of their columns
void drawCells(std::ostream& out, int left, const std::vector<std::string>& rows,
  const std::set<double>& moduli, const Cells& cells)
{
  int x = left;
  for (const double modulus : moduli)
  {
    out << "<text transform=\"translate(" << x + kCell / 2 + 4 << "," << kHead - 6
        << ") rotate(-40)\">" << columnName(modulus) << "</text>\n";
    int y = kHead;
    for (const std::string& row : rows)
    {
      const auto cell = cells.find({ row, modulus });
      if (cell != cells.end())
      {
        out << R"(<rect x=")" << x << R"(" y=")" << y << R"(" width=")" << kCell - 2
            << R"(" height=")" << kRow - 2 << R"(" fill=")" << colorOf(cell->second) << "\"/>\n";
      }
      y += kRow;
    }
    x += kCell;
  }
}

// what rows, columns and colors are
void drawLegend(std::ostream& out, const std::vector<std::string>& rows)
{
  int y = kHead;
  for (const std::string& row : rows)
  {
    text(out, kLabels - 8, y + kRow - 7, row, R"(text-anchor="end")");
    y += kRow;
  }
  text(out, kLabels, y + 18, "Young's modulus; rows: loop period, then what was varied at 1 ms");
  int x = kLabels;
  for (const StabilityOutcome outcome : { StabilityOutcome::Stable, StabilityOutcome::Limited,
         StabilityOutcome::Refused, StabilityOutcome::Unstable })
  {
    out << R"(<rect x=")" << x << R"(" y=")" << y + 32 << R"(" width="14" height="14" fill=")"
        << colorOf(outcome) << "\"/>\n";
    text(out, x + 20, y + 44, nameOf(outcome));
    x += 90;
  }
}

} // namespace

const char* nameOf(StabilityOutcome outcome)
{
  switch (outcome)
  {
    case StabilityOutcome::Stable:
      return "stable";
    case StabilityOutcome::Limited:
      return "limited";
    case StabilityOutcome::Refused:
      return "refused";
    case StabilityOutcome::Unstable:
      return "unstable";
  }
  return "";
}

void drawStabilityMap(std::ostream& out, std::span<const JudgedCase> cases)
{
  std::vector<std::string> rows; // in the order of the cases
  std::set<double> moduli;
  for (const JudgedCase& one : cases)
  {
    moduli.insert(modulusOf(one.what));
    if (std::ranges::find(rows, rowName(one.what)) == rows.end())
    {
      rows.push_back(rowName(one.what));
    }
  }
  const int panel = static_cast<int>(moduli.size()) * kCell;
  const int height = kHead + static_cast<int>(rows.size()) * kRow + kFoot;
  out << R"(<svg xmlns="http://www.w3.org/2000/svg" width=")" << kLabels + 2 * panel + 60
      << R"(" height=")" << height << R"(" viewBox="0 0 )" << kLabels + 2 * panel + 60 << ' '
      << height << "\" font-family=\"sans-serif\" font-size=\"11\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  text(out, 12, 24, "Closed loop of hand, device and tissue: worst outcome of each cell",
    R"(font-size="15")");

  for (const bool chain : { false, true })
  {
    const int left = kLabels + (chain ? panel + 30 : 0);
    const Cells cells = worstOf(cases, chain);
    text(out, left, 46, chain ? "through the safety chain" : "the law alone, cut at 7.9 N",
      R"(font-size="13")");
    drawCells(out, left, rows, moduli, cells);
  }
  drawLegend(out, rows);
  out << "</svg>\n";
}

} // namespace palp
