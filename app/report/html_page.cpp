#include "app/report/html_page.h"

#include "calibration/figures/palette.h"
#include "haptics/error.h"
#include "haptics/files/listed.h"
#include "haptics/files/replace_file.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace palp::report
{
namespace
{

// as 166 ranges of two quick reports on one idle machine did
constexpr const char* kBetweenRuns =
  "Times are medians, with the lowest and the highest of repeated runs beside them. What else runs "
  "on a machine, and its clock, move from one report to the next: expect the ranges of two "
  "reports to meet once both are widened by 8 %. Columns per S are divided by a fixed piece of "
  "work timed in the same run and come closer: compare machines and runs by them.";

constexpr const char* kStyle = R"(<style>
body { font: 16px/1.5 "Source Serif 4", Charter, Georgia, serif; color: #1a1c21; max-width: 72rem;
  margin: 2rem auto; padding: 0 1.5rem; }
h1, h2, figcaption, caption, table, nav, .legend { font-family: "DejaVu Sans", Helvetica, Arial,
  sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.25; }
h2 { font-size: 1.25rem; margin-top: 3rem; border-bottom: 1px solid #c8ccd2; padding-bottom: .3rem; }
p { max-width: 48rem; }
a { color: #00548a; }
nav li { margin: .15rem 0; }
figure { margin: 1.5rem 0; break-inside: avoid; }
.charts { display: grid; grid-template-columns: repeat(3, 1fr); gap: 1rem; }
.charts.alone { grid-template-columns: minmax(20rem, 44rem); }
.charts svg { width: 100%; height: auto; }
.wide svg { max-width: 100%; height: auto; }
svg text { font-family: "DejaVu Sans", Helvetica, Arial, sans-serif; }
.part { font-size: .8rem; text-align: center; margin: 0; }
figcaption { font-size: .85rem; max-width: 52rem; }
.legend { font-size: .8rem; display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; margin: .4rem 0; }
.legend svg { width: 1.6rem; height: .9rem; vertical-align: -.1rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .78rem; margin: 1rem 0; }
caption { text-align: left; font-size: .85rem; padding-bottom: .4rem; max-width: 52rem; }
th, td { padding: .15rem .6rem; text-align: left; border-bottom: 1px solid #e3e6ea;
  vertical-align: top; }
thead th { border-bottom: 1px solid #1a1c21; white-space: nowrap; vertical-align: bottom; }
td:nth-child(-n+3) { white-space: nowrap; }
#claims td { white-space: normal; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.missing { border-left: 4px solid #d55e00; padding-left: .8rem; }
@media (max-width: 50rem) { .charts { grid-template-columns: 1fr; } }
@media print { body { font-size: 10pt; max-width: none; margin: 0; } h2 { break-after: avoid; }
  a { color: inherit; text-decoration: none; } .scroll { overflow: visible; }
  tr { break-inside: avoid; }
  .charts { grid-template-columns: repeat(3, 1fr); }
  .charts.alone { grid-template-columns: 70%; }
  * { print-color-adjust: exact; } }
</style>
)";

std::string escape(const std::string& text)
{
  std::string safe;
  for (const char c : text)
  {
    switch (c)
    {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string fileLink(const std::string& name)
{
  return "<a href=\"" + name + "\">" + name + "</a>";
}

// the mark of a curve, as in the figure
std::string markOf(const Curve& curve)
{
  const std::string color = figures::paletteColor(curve.color);
  switch (curve.style)
  {
    case Curve::Style::Line:
      return R"(<path d="M1 7H27" stroke-width="2.5" stroke=")" + color + R"("/>)";
    case Curve::Style::Dashed:
      return R"(<path d="M1 7H27" stroke-width="2" stroke-dasharray="6 4" stroke=")" + color +
        R"("/>)";
    case Curve::Style::Circles:
      return R"(<circle cx="14" cy="7" r="4.5" fill=")" + color + R"("/>)";
    case Curve::Style::Squares:
      return R"(<path d="M10 3h8v8h-8z" fill=")" + color + R"("/>)";
    case Curve::Style::Diamonds:
      return R"(<path d="M14 1l6 6-6 6-6-6z" fill=")" + color + R"("/>)";
    case Curve::Style::Cells:
      return R"(<path d="M9 2h10v10H9z" fill=")" + std::string(figures::shadeColor(curve.color)) +
        R"("/>)";
  }
  return {};
}

std::string legendEntry(const std::string& mark, const std::string& label)
{
  return R"(<span><svg viewBox="0 0 28 14" aria-hidden="true">)" + mark + "</svg> " +
    escape(label) + "</span>";
}

// an SVG file without what only a file of its own needs
std::string inlineSvg(const std::filesystem::path& file)
{
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  const std::size_t begin = text.str().find("<svg");
  if (begin == std::string::npos)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": no picture in it; make the report again");
  }
  return text.str().substr(begin);
}

void writeFigure(std::ostream& out, const std::filesystem::path& folder, const Section& section,
  std::span<const Figure> group)
{
  const bool alone = group.size() == 1;
  out << "<figure>\n<div class=\"charts" << (alone ? " alone" : "") << "\">\n";
  for (const Figure& figure : group)
  {
    out << "<div>" << inlineSvg(folder / (figure.name + ".svg"));
    if (!alone)
    {
      out << "<p class=\"part\">" << escape(figure.caption) << "</p>";
    }
    out << "</div>\n";
  }
  out << "</div>\n<div class=\"legend\">";
  if (group.front().band > 0.0)
  {
    const std::string band = R"(<path d="M1 1H27V13H1z" fill=")" + std::string(figures::kBandColor);
    out << legendEntry(band + R"(" fill-opacity=".25"/>)", bandLabel(group.front()));
  }
  for (const Curve& curve : group.front().curves)
  {
    if (!curve.label.empty() && !pointsOf(section.tables, curve).x.empty())
    {
      out << legendEntry(markOf(curve), curve.label);
    }
  }
  out << "</div>\n<figcaption>" << escape(alone ? group.front().caption : group.front().group)
      << " Data: ";
  std::vector<std::string> named;
  for (const Figure& figure : group)
  {
    for (const Curve& curve : figure.curves)
    {
      if (std::ranges::find(named, curve.table) == named.end())
      {
        out << (named.empty() ? "" : ", ") << fileLink(curve.table + ".csv");
        named.push_back(curve.table);
      }
    }
  }
  out << ".</figcaption>\n</figure>\n";
}

void writeTable(std::ostream& out, const Table& table)
{
  out << "<div class=\"scroll\"><table>\n<caption>" << escape(table.caption) << ' '
      << fileLink(table.name + ".csv") << "</caption>\n<thead><tr>";
  for (const std::string& column : table.columns)
  {
    out << "<th>" << escape(column) << "</th>";
  }
  out << "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows)
  {
    out << "<tr>";
    for (const Cell& cell : row)
    {
      const bool number = std::holds_alternative<double>(cell);
      out << (number ? "<td class=\"number\">" : "<td>") << escape(shown(cell)) << "</td>";
    }
    out << "</tr>\n";
  }
  out << "</tbody>\n</table></div>\n";
}

void writeSection(std::ostream& out, const std::filesystem::path& folder, const Section& section)
{
  out << "<section id=\"" << section.name << "\">\n<h2>" << escape(section.title) << "</h2>\n";
  for (const std::string& paragraph : section.text)
  {
    out << "<p>" << escape(paragraph) << "</p>\n";
  }
  const std::span all(section.figures);
  for (std::size_t begin = 0; begin < all.size();)
  {
    std::size_t end = begin + 1;
    while (end < all.size() && !all[begin].group.empty() && all[end].group == all[begin].group)
    {
      ++end;
    }
    writeFigure(out, folder, section, all.subspan(begin, end - begin));
    begin = end;
  }
  for (const Picture& picture : section.pictures)
  {
    out << "<figure class=\"wide\">" << picture.svg << "<figcaption>" << escape(picture.caption)
        << " File: " << fileLink(picture.name) << ".</figcaption></figure>\n";
  }
  std::string others;
  for (const Table& table : section.tables)
  {
    if (table.shown)
    {
      writeTable(out, table);
    }
    else
    {
      addListed(others, fileLink(table.name + ".csv"));
    }
  }
  out << "<p>All numbers of this part: " << (others.empty() ? "" : others + ", ")
      << fileLink(section.name + ".json") << ".</p>\n</section>\n";
}

void writeHead(std::ostream& out, const nlohmann::ordered_json& machine,
  const std::vector<Section>& sections, const std::vector<std::string>& unfinished)
{
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width\">\n<title>Palp: error against run "
         "time</title>\n"
      << kStyle
      << "</head>\n<body>\n<h1>Palp: accuracy, speed and stability of analytical force "
         "rendering</h1>\n";
  out << "<table>\n";
  for (const auto& [key, value] : machine.items())
  {
    const Cell cell =
      value.is_number() ? Cell(value.get<double>()) : Cell(value.get<std::string>());
    out << "<tr><th scope=\"row\">" << escape(key) << "</th><td>" << escape(shown(cell))
        << "</td></tr>\n";
  }
  out << "</table>\n<p>The same as data: " << fileLink("machine.json") << ".</p>\n<p>"
      << kBetweenRuns << "</p>\n<nav><ol>\n";
  for (const Section& section : sections)
  {
    out << "<li><a href=\"#" << section.name << "\">" << escape(section.title) << "</a></li>\n";
  }
  out << "</ol></nav>\n";
  for (const std::string& title : unfinished)
  {
    out << "<p class=\"missing\">Not finished: " << escape(title) << ".</p>\n";
  }
}

} // namespace

void writePage(const std::filesystem::path& folder, const nlohmann::ordered_json& machine,
  const std::vector<Section>& sections, const std::vector<std::string>& unfinished)
{
  std::ostringstream out;
  writeHead(out, machine, sections, unfinished);
  for (const Section& section : sections)
  {
    writeSection(out, folder, section);
  }
  out << "</body>\n</html>\n";
  replaceFile(folder / "report.html", out.str());
}

} // namespace palp::report
