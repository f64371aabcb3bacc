#include "haptics/devices/simulated/scripted_path.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace palp
{
namespace
{

constexpr double kShortestPiece = 1e-6; // [s]
constexpr double kFarthest = 10.0;      // [m]
constexpr double kAxisTolerance = 0.01;
constexpr double kGap = 0.01; // between two samples of a recording that leaves something out [s]

constexpr std::string_view kHeader = "time_s,x_mm,y_mm,z_mm";
constexpr std::string_view kHeaderWithAxis = "time_s,x_mm,y_mm,z_mm,ax,ay,az";

constexpr std::size_t kShortRow = 4;
constexpr std::size_t kLongRow = 7;

constexpr std::string_view kDepth = "depth_mm";
constexpr std::string_view kHand = "hand"; // of which the first's rows are taken
using Names = std::array<std::string_view, kLongRow>;
constexpr Names kOfPaths{ "time_s", "x_mm", "y_mm", "z_mm", "ax", "ay", "az" };
constexpr Names kOfRecordings{ "time_s", "tool_x_mm", "tool_y_mm", "tool_z_mm", "axis_x", "axis_y",
  "axis_z" };

// what is wrong with a knot that follows another; empty when nothing is
std::string fault(const PathKnot* previous, const PathKnot& knot)
{
  if (!std::isfinite(knot.time))
  {
    return "the time is not a finite number";
  }
  if (previous != nullptr && knot.time < previous->time + kShortestPiece)
  {
    return knot.time > previous->time
      ? "less than 1 us after the row before; leave rows out, or give times in seconds"
      : "the time does not increase; give each row a later time than the row before";
  }
  if (!knot.apex.allFinite() || knot.apex.cwiseAbs().maxCoeff() > kFarthest)
  {
    return "the position is farther than 10 m from the origin; give millimeters in the mesh's "
           "frame";
  }
  if (knot.axis && !(std::abs(knot.axis->norm() - 1.0) <= kAxisTolerance))
  {
    return "the axis is not of length one; give the unit vector from handle to apex";
  }
  return {};
}

// takes what stands before the separator, and shortens the text by both
std::string_view cut(std::string_view& text, char separator)
{
  const std::string_view piece = text.substr(0, text.find(separator));
  text.remove_prefix(std::min(text.size(), piece.size() + 1));
  return piece;
}

class Reader
{
public:
  explicit Reader(std::string name)
    : name_(std::move(name))
  {
  }

  std::vector<PathKnot> read(std::string_view text)
  {
    std::vector<PathKnot> knots;
    bool mayBeHeader = true;
    while (!text.empty())
    {
      ++line_;
      const std::string_view row = trimmed(cut(text, '\n'));
      if (row.empty() || row.front() == '#' ||
        (std::exchange(mayBeHeader, false) && readHeader(cellsOf(row))))
      {
        continue;
      }
      const Cells& cells = cellsOf(row);
      if (hand_ && cells.size() == width_ && cells[static_cast<std::size_t>(*hand_)] != "1")
      {
        continue; // of another hand
      }
      PathKnot next = knot(cells);
      const bool isApart = depthOf(cells) == 0.0;
      if (wasApart_ && isApart && next.time > knots.back().time + kGap)
      {
        knots.push_back(knots.back()); // nobody knows the way: it may lead through the body
        knots.back().time = next.time - 2.0 * kShortestPiece;
      }
      wasApart_ = isApart;
      knots.push_back(std::move(next));
      const PathKnot* previous = knots.size() > 1 ? &knots[knots.size() - 2] : nullptr;
      if (const std::string what = fault(previous, knots.back()); !what.empty())
      {
        fail(what);
      }
    }
    if (knots.empty())
    {
      throw Error(ErrorCode::BadFile,
        name_ + ": no row; give rows of " + std::string(kHeader) + ", with ,ax,ay,az if known");
    }
    return knots;
  }

private:
  using Cells = std::vector<std::string_view>;

  // until the next row is read
  const Cells& cellsOf(std::string_view row)
  {
    cells_.clear();
    if (row.find('"') != row.npos)
    {
      fields_ = csvFields(row);
      std::ranges::transform(fields_, std::back_inserter(cells_), trimmed);
    }
    else
    {
      std::ranges::transform(split(row, ','), std::back_inserter(cells_), trimmed);
    }
    if (cells_.size() != width_ && cells_.back().empty()) // behind a last comma
    {
      cells_.pop_back();
    }
    return cells_;
  }

  // finds the columns of a path, or of a recording among its others; false: a row of numbers
  bool readHeader(const Cells& cells)
  {
    const auto has = [&](std::string_view name) { return std::ranges::count(cells, name) > 0; };
    const bool isOfWords = cells.size() >= kShortRow &&
      std::ranges::none_of(
        cells, [](std::string_view cell) { return csvNumber(cell).has_value(); });
    if (!has(kOfPaths[0]) && !isOfWords)
    {
      return false;
    }
    const Names& names = has(kOfRecordings[1]) ? kOfRecordings : kOfPaths;
    const bool turned = has(names[kShortRow]);
    columns_.resize(turned ? kLongRow : kShortRow);
    for (std::size_t i = 0; i < columns_.size(); ++i)
    {
      if (!has(names[i]))
      {
        fail("no column " + std::string(names[i]) + "; give " + std::string(kHeaderWithAxis) +
          ", or a samples.csv that Palp has exported");
      }
      if (std::ranges::count(cells, names[i]) > 1)
      {
        fail("two columns " + std::string(names[i]) + "; leave one of them out");
      }
      columns_[i] = static_cast<std::size_t>(std::ranges::find(cells, names[i]) - cells.begin());
    }
    width_ = cells.size();
    const auto find = [&](std::string_view name)
    {
      const auto at = std::ranges::find(cells, name);
      return at == cells.end() ? std::nullopt : std::optional(at - cells.begin());
    };
    depth_ = find(kDepth);
    hand_ = &names == &kOfRecordings ? find(kHand) : std::nullopt;
    return true;
  }

  // of a recording; none of a path
  [[nodiscard]] std::optional<double> depthOf(const Cells& cells) const
  {
    return depth_ ? std::optional(number(cells[static_cast<std::size_t>(*depth_)])) : std::nullopt;
  }

  [[nodiscard]] PathKnot knot(const Cells& cells) const
  {
    if (width_ != 0 && cells.size() != width_)
    {
      fail("a row of " + std::to_string(cells.size()) + " columns below a header of " +
        std::to_string(width_));
    }
    const std::size_t count = width_ != 0 ? columns_.size() : cells.size();
    std::array<double, kLongRow> values{};
    for (std::size_t i = 0; i < std::min(count, values.size()); ++i)
    {
      values[i] = number(cells[width_ != 0 ? columns_[i] : i]);
    }
    if (count != kShortRow && count != kLongRow)
    {
      fail("a row has 4 or 7 columns; give " + std::string(kHeaderWithAxis));
    }
    PathKnot knot;
    knot.time = values[0];
    std::transform(&values[1], &values[kShortRow], knot.apex.data(), units::fromMillimeters);
    if (count == kLongRow)
    {
      knot.axis = Eigen::Vector3d::Map(&values[kShortRow]);
    }
    return knot;
  }

  [[nodiscard]] double number(std::string_view text) const
  {
    const std::optional<double> value = csvNumber(text);
    if (!value && text.find_first_of(";\t") != std::string_view::npos)
    {
      fail("columns are not separated by commas; write rows as 0,1.5,-2,3 below a header " +
        std::string(kHeader));
    }
    if (!value || !std::isfinite(*value))
    {
      fail(std::string{ '"' }.append(printable(std::string(text.substr(0, 40)))) +
        "\" is not a number; write it as -1.25, below a header " + std::string(kHeader));
    }
    return *value;
  }

  [[noreturn]] void fail(const std::string& what) const
  {
    throw Error(ErrorCode::BadFile, name_ + ":" + std::to_string(line_) + ": " + what);
  }

  std::string name_;
  int line_ = 0;
  Cells cells_;                           // of the row
  std::vector<std::string> fields_;       // that own them where they were in quotes
  std::vector<std::size_t> columns_;      // of time, position and axis below a header
  std::size_t width_ = 0;                 // of the header; 0 without one
  std::optional<std::ptrdiff_t> depth_{}; // column
  std::optional<std::ptrdiff_t> hand_{};  // likewise
  bool wasApart_ = false;                 // the tool in the row before, of a recording
};

} // namespace

ScriptedPath::ScriptedPath(std::vector<PathKnot> knots)
  : knots_(std::move(knots))
{
  if (knots_.empty())
  {
    throw Error(ErrorCode::BadValue, "path: no knot; give at least one");
  }
  const PathKnot* previous = nullptr;
  for (PathKnot& knot : knots_)
  {
    if (const std::string what = fault(previous, knot); !what.empty())
    {
      throw Error(
        ErrorCode::BadValue, "path: knot " + std::to_string(&knot - knots_.data()) + ": " + what);
    }
    if (knot.axis)
    {
      knot.axis->normalize();
    }
    previous = &knot;
  }
}

bool ScriptedPath::hasAxes() const noexcept
{
  return std::ranges::all_of(knots_, [](const PathKnot& knot) { return knot.axis.has_value(); });
}

ToolPose ScriptedPath::poseAt(double time, const Eigen::Vector3d& missingAxis) const noexcept
{
  const auto later = std::ranges::upper_bound(knots_, time, {}, &PathKnot::time);
  const bool atEnd = later == knots_.end() && time == knots_.back().time && knots_.size() > 1;
  if (later == knots_.begin() || (later == knots_.end() && !atEnd))
  {
    const PathKnot& knot = later == knots_.begin() ? knots_.front() : knots_.back();
    return { .apex = knot.apex, .axis = knot.axis.value_or(missingAxis) };
  }

  const PathKnot& to = atEnd ? knots_.back() : *later;
  const PathKnot& from = *(&to - 1);
  const double length = to.time - from.time;
  const double fraction = (time - from.time) / length;
  ToolPose pose;
  pose.apex = from.apex + fraction * (to.apex - from.apex);
  pose.velocity = (to.apex - from.apex) / length;

  // the chord between two unit vectors, made a unit vector again; opposite ones have no middle
  const Eigen::Vector3d start = from.axis.value_or(missingAxis);
  const Eigen::Vector3d chord = start + fraction * (to.axis.value_or(missingAxis) - start);
  pose.axis = chord.norm() > kAxisTolerance ? chord.normalized() : start;
  return pose;
}

ScriptedPath parsePath(std::string_view text, const std::string& name)
{
  return ScriptedPath(Reader(name).read(text));
}

ScriptedPath readPath(const std::filesystem::path& file)
{
  return parsePath(readText(file, "the CSV file"), file.string());
}

} // namespace palp
