#include "app/check/check_text.h"

#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace palp
{
namespace
{

using units::toMillimeters;

// what becomes of a fault
struct Consequence
{
  const char* onLoading;
  const char* inAPress; // empty: nothing
};

Consequence consequenceOf(Fault fault) noexcept
{
  switch (fault)
  {
    case Fault::DuplicatePoint:
      return { "merged", "" };
    case Fault::UnusedPoint:
    case Fault::Degenerate:
    case Fault::InnerPiece:
      return { "left out", "" };
    case Fault::Flipped:
      return { "turned", "" };
    case Fault::DuplicateTriangle:
    case Fault::NonManifoldEdge:
      return { "kept", "inside and outside are not told apart near there" };
    case Fault::Sliver:
      return { "kept", "normal and curvature are rough there" };
    case Fault::NonManifoldPoint:
      return { "kept", "the normal is mixed at that point" };
    case Fault::Hole:
      return { "kept", "to be pressed from the front; flagged as an edge near there" };
    case Fault::SelfIntersection:
      return { "what is buried is left out, where closed", "the depth is uncertain near there" };
  }
  return { "kept", "" };
}

std::string text(double value)
{
  return figures::textOf(value, kCheckDigits);
}

std::string inMillimeters(const Eigen::Vector3d& place)
{
  return text(toMillimeters(place.x())) + "," + text(toMillimeters(place.y())) + "," +
    text(toMillimeters(place.z()));
}

std::string sizeOf(const MeshHealth& health)
{
  const Eigen::Vector3d size = health.high - health.low;
  return counted(health.points, "point") + ", " + counted(health.triangles, "triangle") + ", " +
    text(toMillimeters(size.x())) + " x " + text(toMillimeters(size.y())) + " x " +
    text(toMillimeters(size.z())) + " mm";
}

std::string piecesOf(const MeshHealth& health)
{
  constexpr std::size_t kMost = 5;
  std::string line = counted(health.pieces.size(), "piece");
  for (std::size_t i = 0; i < std::min(kMost, health.pieces.size()); ++i)
  {
    const MeshPiece& piece = health.pieces[i];
    line += (i == 0 ? ": " : "; ") + counted(piece.triangles, "triangle") +
      (piece.closed ? ", closed, " + text(units::toMilliliters(std::abs(piece.volume))) + " ml"
                    : ", open");
  }
  return line + (health.pieces.size() > kMost ? "; ..." : "");
}

// how many edges there are of each length, by octaves
std::string edgesOf(const std::vector<double>& lengths)
{
  std::map<int, std::size_t> octaves;
  for (const double length : lengths)
  {
    ++octaves[static_cast<int>(std::floor(std::log2(std::max(toMillimeters(length), 1e-6))))];
  }
  std::string line = counted(lengths.size(), "edge") + " of " +
    text(toMillimeters(lengths.front())) + " to " + text(toMillimeters(lengths.back())) +
    " mm, median " + text(toMillimeters(lengths[lengths.size() / 2])) + " mm:";
  for (const auto& [octave, count] : octaves)
  {
    line.append(" ").append(std::to_string(count)).append(" from ");
    line.append(text(std::exp2(octave))).append(" mm,");
  }
  line.pop_back();
  return line;
}

} // namespace

bool disturbs(Fault fault) noexcept
{
  return *consequenceOf(fault).inAPress != '\0';
}

bool disturbs(const MeshHealth& health) noexcept
{
  return std::ranges::any_of(
    health.findings, [](const Finding& one) { return disturbs(one.fault); });
}

std::string verdictOf(const MeshHealth& health)
{
  std::string names;
  for (const Finding& one : health.findings)
  {
    disturbs(one.fault) ? addListed(names, nameOf(one.fault)) : void();
  }
  return !names.empty()       ? "A press is disturbed by: " + names
    : health.findings.empty() ? "No fault was found: nothing disturbs a press"
                              : "Nothing disturbs a press: loading mends all that was found";
}

figures::Table faultTable(const MeshHealth& health, const Eigen::Isometry3d& frame)
{
  figures::Table table{ .name = "check",
    .caption = "Faults",
    .columns = { "fault", "count", "place_mm", "longest_around_mm", "on_loading", "in_a_press" } };
  for (const Finding& one : health.findings)
  {
    const auto [onLoading, inAPress] = consequenceOf(one.fault);
    table.rows.push_back(
      { std::string(nameOf(one.fault)), std::to_string(one.count), inMillimeters(frame * one.place),
        one.size > 0.0 ? figures::Cell(toMillimeters(one.size)) : figures::Cell(std::string()),
        std::string(onLoading), std::string(inAPress) });
  }
  return table;
}

std::vector<std::string> measuresOf(const MeshHealth& health, const std::filesystem::path& file)
{
  std::vector<std::string> lines{ printable(file.filename().string()) + ": " + sizeOf(health),
    piecesOf(health) };
  health.edgeLengths.empty() ? void() : lines.push_back(edgesOf(health.edgeLengths));
  return lines;
}

std::string doneIn(const RepairedMesh& repaired)
{
  std::string line;
  const auto add = [&](std::size_t count, const char* what, const char* many, const char* done)
  { count > 0 ? addListed(line, counted(count, what, many) + done) : void(); };
  add(repaired.merged, "point", "points", " merged or left out");
  add(repaired.removed, "triangle", "triangles", " removed");
  add(repaired.cut, "triangle", "triangles", " added where points lay on edges of others");
  add(repaired.split, "point", "points", " added where parts met");
  add(repaired.slivers, "sliver", "slivers", " removed");
  add(repaired.filled, "hole", "holes", " closed");
  add(repaired.turned, "triangle", "triangles", " turned");
  line = line.empty() ? "nothing to repair" : line;
  add(repaired.seamsLeft, "edge", "edges",
    " left open beside others, as not all of a seam is within 1/50 of its edges");
  add(repaired.splitLeft, "point", "points", " left where parts meet, as these would cross");
  add(repaired.sliversLeft, "sliver", "slivers", " left, as the surface would cross itself");
  add(repaired.holesLeft, "hole", "holes", " left, as what closes them would cross the surface");
  add(repaired.holesUnfit, "hole", "holes",
    " left, of more than 500 edges, or which no triangles fit but such as the surface has");
  return line;
}

} // namespace palp
