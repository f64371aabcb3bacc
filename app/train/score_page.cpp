// The sheet as one page, with a map of what was searched.

#include "app/train/score_sheet.h"
#include "haptics/files/csv_text.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace palp
{
namespace
{

using units::toMillimeters;

constexpr const char* kStyle = R"(<style>
body { font: 15px/1.5 "DejaVu Sans", Helvetica, Arial, sans-serif; color: #1a1c21; max-width: 60rem;
  margin: 2rem auto; padding: 0 1.5rem; }
table { border-collapse: collapse; font-size: .85rem; }
td, th { padding: .15rem .7rem; text-align: left; border-bottom: 1px solid #e3e6ea; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
td.source { color: #5a5f68; }
svg { width: 100%; max-height: 26rem; }
@media print { body { font-size: 9pt; margin: 0; } * { print-color-adjust: exact; } }
</style>)";

std::string escaped(const std::string& text)
{
  std::string safe;
  for (const char c : text)
  {
    safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return safe;
}

std::string number(double value)
{
  return shortest(std::round(10.0 * value) / 10.0);
}

// a place as it is seen from the side that is searched, in mm
class Map
{
public:
  explicit Map(const Eigen::Vector3d& side)
    : side_(side.normalized())
  {
    const bool isTop = std::abs(side_.z()) > 0.9;
    const Eigen::Vector3d up = isTop ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
    right_ = up.cross(side_).normalized();
    up_ = side_.cross(right_);
  }

  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector3d& place) const
  {
    return { toMillimeters(place.dot(right_)), -toMillimeters(place.dot(up_)) };
  }

private:
  Eigen::Vector3d side_;
  Eigen::Vector3d right_;
  Eigen::Vector3d up_;
};

std::string circle(
  const Eigen::Vector2d& at, double radius, const std::string& look, const std::string& title = "")
{
  const std::string head = "<circle cx=\"" + number(at.x()) + "\" cy=\"" + number(at.y()) +
    "\" r=\"" + number(radius) + "\" " + look;
  return title.empty() ? head + "/>\n" : head + "><title>" + title + "</title></circle>\n";
}

std::string cross(const Eigen::Vector2d& at, const char* color, const std::string& title)
{
  constexpr double kArm = 3.0; // [mm]
  const auto line = [&](double turn)
  {
    return number(at.x() - kArm) + " " + number(at.y() - turn * kArm) + "L" +
      number(at.x() + kArm) + " " + number(at.y() + turn * kArm);
  };
  return R"(<path d="M)" + line(1.0) + "M" + line(-1.0) + R"(" stroke=")" + color +
    R"(" stroke-width="1.2" fill="none"><title>)" + title + "</title></path>\n";
}

std::string mapOf(const ScoreSheet& sheet)
{
  constexpr std::size_t kEach = 5; // of the points
  const Grade& grade = sheet.grade;
  const Map map(sheet.plan.side);
  Eigen::AlignedBox2d box;
  std::string dots;
  for (std::size_t i = 0; i < grade.area.points.size(); i += kEach)
  {
    const Eigen::Vector2d at = map.at(grade.area.points[i].position);
    box.extend(at);
    dots += circle(at, 0.7, grade.touched[i] ? R"(fill="#8fb8de")" : R"(fill="#e4e6ea")");
  }
  std::string drawn;
  for (std::size_t i = 0; i < grade.nodules.size(); ++i)
  {
    const GradedNodule& one = grade.nodules[i];
    const char* color = one.foundBy ? "#1a7f37" : "#d55e00";
    const std::string name = "nodule " + std::to_string(i + 1);
    drawn += circle(map.at(one.nodule.nodule.center), toMillimeters(one.nodule.nodule.radius),
      std::string(R"(fill=")") + color + R"(" fill-opacity="0.5")", name);
    drawn += circle(map.at(one.above), toMillimeters(sheet.hitWithin),
      std::string(R"(fill="none" stroke-dasharray="2 1.5" stroke-width="0.5" stroke=")") + color +
        '"',
      name);
  }
  for (std::size_t i = 0; i < grade.marks.size(); ++i)
  {
    const GradedMark& mark = grade.marks[i];
    drawn += cross(map.at(mark.place), mark.isNear ? "#1a1c21" : "#c1121f",
      "mark " + std::to_string(i + 1) + " at " + number(mark.time) + " s");
  }
  const Eigen::Vector2d size = box.sizes();
  return R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox=")" + number(box.min().x() - 3.0) +
    ' ' + number(box.min().y() - 3.0) + ' ' + number(size.x() + 6.0) + ' ' +
    number(size.y() + 6.0) + "\">\n" + dots + drawn + "</svg>\n";
}

std::string tableOf(const ScoreSheet& sheet)
{
  std::string rows;
  for (const Measure& one : measuresOf(sheet))
  {
    const std::string value = one.value.empty() ? "-" : one.value;
    rows += "<tr><td>" + one.title + "</td><td class=\"number\">" + value + ' ' + one.unit +
      "</td><td class=\"source\">" + escaped(one.source) + "</td></tr>\n";
  }
  return "<table>\n<tr><th>Measure</th><th>Value</th><th>Source</th></tr>\n" + rows + "</table>\n";
}

} // namespace

std::string scorePage(const ScoreSheet& sheet)
{
  const std::string title = "Palpation training: " + summaryOf(sheet.grade);
  const std::string next = sheet.grade.isPassed
    ? "Passed" + (sheet.next.empty() ? "." : "; next level: " + escaped(sheet.next) + ".")
    : std::string("Not passed: search again with another seed.");
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + title +
    "</title>\n" + kStyle + "\n</head><body>\n<h1>" + title + "</h1>\n<p>" + escaped(sheet.body) +
    ", level " + escaped(sheet.level.name) + " (" + escaped(sheet.level.title) + "), seed " +
    std::to_string(sheet.plan.seed) + ", tool " + escaped(sheet.tool) + ". " + next + "</p>\n" +
    mapOf(sheet) +
    "<p>Blue: touched. Disks: nodules, green found, orange missed, with the circle in which a mark "
    "finds them. Crosses: marks, red where false.</p>\n" +
    tableOf(sheet) + "</body></html>\n";
}

} // namespace palp
