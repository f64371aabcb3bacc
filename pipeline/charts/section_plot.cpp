#include "haptics/units.h"
#include "pipeline/charts/comparison.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCleanPolyData.h>
#include <vtkCutter.h>
#include <vtkIdList.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStripper.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kSteps = 200;
constexpr appearance::Color kToolLine{ 0.45, 0.47, 0.50 };

struct Line
{
  std::vector<double> x; // [mm] from the contact's center
  std::vector<double> y; // [mm] along the normal

  void add(double along, double up)
  {
    x.push_back(units::toMillimeters(along));
    y.push_back(units::toMillimeters(up));
  }
};

// the plane of the cut
struct Frame
{
  Eigen::Vector3d center;
  Eigen::Vector3d along;
  Eigen::Vector3d up;

  [[nodiscard]] Eigen::Vector2d inPlane(const Eigen::Vector3d& point) const
  {
    return { (point - center).dot(along), (point - center).dot(up) };
  }
};

// what is drawn, and where it was at rest, from left to right along the surface
struct Cut
{
  Line drawn;
  Line rest;
  std::size_t middle = 0; // the point at the contact's center
};

// a point of the cut, in the frame's plane [m]
struct CutPoint
{
  Eigen::Vector2d drawn;
  Eigen::Vector2d rest;
};

std::size_t middleOf(const std::vector<CutPoint>& line)
{
  const auto nearer = [](const CutPoint& a, const CutPoint& b)
  { return a.rest.squaredNorm() < b.rest.squaredNorm(); };
  return static_cast<std::size_t>(
    std::min_element(line.begin(), line.end(), nearer) - line.begin());
}

// Near an edge the plane meets the surface several times above one place: the line has to follow
// the surface, not the plane's axis. Of several lines the one through the contact.
std::vector<CutPoint> followSurface(vtkPolyData* segments, const Frame& frame)
{
  // a plane through a corner cuts the triangles there a rounding error apart
  vtkNew<vtkCleanPolyData> merged;
  merged->SetInputData(segments);
  merged->ToleranceIsAbsoluteOn();
  merged->SetAbsoluteTolerance(0.1_um);
  merged->ConvertLinesToPointsOff();
  vtkNew<vtkStripper> joined;
  joined->SetInputConnection(merged->GetOutputPort());
  joined->SetMaximumLength(std::numeric_limits<int>::max());
  joined->JoinContiguousSegmentsOn();
  joined->Update();
  vtkPolyData* lines = joined->GetOutput();
  vtkDataArray* moved = lines->GetPointData()->GetArray("Displacement");
  std::vector<CutPoint> nearest;
  double least = std::numeric_limits<double>::infinity(); // [m]
  const auto cells = vtk::TakeSmartPointer(lines->GetLines()->NewIterator());
  for (cells->GoToFirstCell(); moved && !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdList* ids = cells->GetCurrentCell();
    std::vector<CutPoint> line;
    for (const vtkIdType id : *ids)
    {
      Eigen::Vector3d point;
      Eigen::Vector3d displacement;
      lines->GetPoint(id, point.data());
      moved->GetTuple(id, displacement.data());
      const Eigen::Vector3d rest = point - displacement;
      line.push_back({ frame.inPlane(point), frame.inPlane(rest) });
    }
    const double distance = line[middleOf(line)].rest.norm();
    if (distance < least)
    {
      least = distance;
      nearest = std::move(line);
    }
  }
  return nearest;
}

Cut cutDent(vtkPalpDeformFilter& press, const Frame& frame)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(frame.center.data());
  plane->SetNormal(Eigen::Vector3d(frame.up.cross(frame.along)).data());
  vtkNew<vtkCutter> cutter;
  cutter->SetCutFunction(plane);
  cutter->SetInputConnection(press.GetOutputPort(1));
  cutter->Update();
  std::vector<CutPoint> points = followSurface(cutter->GetOutput(), frame);
  Cut cut;
  if (points.empty())
  {
    return cut;
  }
  // a closed line begins and ends behind the contact
  if (points.size() > 2 && points.front().drawn == points.back().drawn)
  {
    points.pop_back();
    const auto count = static_cast<std::ptrdiff_t>(points.size());
    const auto behind = (static_cast<std::ptrdiff_t>(middleOf(points)) + count / 2) % count;
    std::rotate(points.begin(), points.begin() + behind, points.end());
  }
  cut.middle = middleOf(points);
  const std::size_t before = cut.middle == 0 ? 0 : cut.middle - 1;
  const std::size_t after = std::min(cut.middle + 1, points.size() - 1);
  if (points[before].rest.x() > points[after].rest.x())
  {
    std::reverse(points.begin(), points.end());
    cut.middle = points.size() - 1 - cut.middle;
  }
  for (const CutPoint& point : points)
  {
    cut.drawn.add(point.drawn.x(), point.drawn.y());
    cut.rest.add(point.rest.x(), point.rest.y());
  }
  return cut;
}

Line cutTool(const Press& press, const Frame& frame)
{
  const ToolBody body(press.tip, press.pose);
  const double base = baseRadius(press.tip);
  Line tool;
  for (int i = -kSteps; i <= kSteps; ++i)
  {
    const double along = 0.9999 * base * i / kSteps;
    const double height = body.lowest(frame.center + along * frame.along, frame.up);
    if (std::isfinite(height) && height < base)
    {
      tool.add(along, height);
    }
  }
  return tool;
}

// goes along with the body below the contact
Line withBody(const vtkPalpDeformFilter& press, const Line& line, const Frame& frame)
{
  Line moved;
  for (std::size_t i = 0; i < line.x.size(); ++i)
  {
    const Eigen::Vector3d point = frame.center + units::fromMillimeters(line.x[i]) * frame.along +
      units::fromMillimeters(line.y[i]) * frame.up;
    const Eigen::Vector2d now = frame.inPlane(press.WithBody(point, frame.center));
    moved.add(now.x(), now.y());
  }
  return moved;
}

// the curve of a patch's edge on one side, laid as it is over the surface at rest
void addBezier(Plot& plot, const Dent& dent, int direction, double side, const Frame& frame,
  const Cut& cut, Line& control)
{
  const Line& rest = cut.rest;
  const RingCurve& ring = dent.field().curve(direction);
  const std::array<std::pair<double, double>, 3> sinks{ std::pair(ring.inner, ring.sink),
    std::pair(ring.meet, 0.0), std::pair(ring.outer, 0.0) };
  Line curve;
  const std::size_t count = side > 0.0 ? rest.x.size() - cut.middle : cut.middle + 1;
  double last = 0.0; // distance [m] of the point before
  std::size_t next = 0;
  for (std::size_t i = 0; i < count && next < sinks.size(); ++i)
  {
    const std::size_t at = side > 0.0 ? cut.middle + i : cut.middle - i; // outwards
    const std::size_t before = i == 0 ? at : (side > 0.0 ? at - 1 : at + 1);
    const double along = units::fromMillimeters(rest.x[at]);
    const double up = units::fromMillimeters(rest.y[at]);
    const double distance =
      dent.region().geodesicInFront(frame.center + along * frame.along + up * frame.up).distance;
    for (; next < sinks.size() && distance >= sinks[next].first; ++next)
    {
      const double t = (sinks[next].first - last) / std::max(distance - last, 1e-12);
      control.x.push_back(rest.x[before] + t * (rest.x[at] - rest.x[before]));
      control.y.push_back(rest.y[before] + t * (rest.y[at] - rest.y[before]) -
        units::toMillimeters(sinks[next].second));
    }
    if (distance >= ring.inner && distance <= ring.outer)
    {
      curve.add(along, up - ring.sinkAt(distance));
    }
    last = distance;
  }
  // one entry in the legend for both sides
  plot.addLine(side > 0.0 ? "B\u00e9zier curve, Eq. (8)" : "", curve.x, curve.y,
    appearance::curveColor(0), 1.5F);
}

// the curve of elements outside the contact, below what was at rest there
void addElements(Plot& plot, const SurfaceProfile& elements, const Line& rest)
{
  for (const double side : { -1.0, 1.0 })
  {
    Line line;
    for (std::size_t i = 0; i < rest.x.size(); ++i)
    {
      const double radius = side * units::fromMillimeters(rest.x[i]);
      if (radius >= elements.inner)
      {
        line.add(side * radius, units::fromMillimeters(rest.y[i]) - elements.sinkAt(radius));
      }
    }
    plot.addLine(side < 0.0 ? "finite elements, on a plane" : "", line.x, line.y,
      appearance::curveColor(2), 2.0F, appearance::LineStyle::Dashed);
  }
}

void addNodules(Plot& plot, const vtkPalpDeformFilter& press, const Frame& frame,
  std::span<const PlacedNodule> nodules)
{
  std::string name = "nodule, at rest"; // once for all of them
  for (const PlacedNodule& nodule : nodules)
  {
    const double off = (nodule.center - frame.center).dot(frame.up.cross(frame.along));
    if (std::abs(off) < nodule.radius)
    {
      const double radius = std::sqrt(nodule.radius * nodule.radius - off * off);
      const Eigen::Vector2d center = frame.inPlane(nodule.center);
      Line circle;
      for (int i = 0; i <= kSteps; ++i)
      {
        const double angle = 2.0 * std::numbers::pi * i / kSteps;
        circle.add(center.x() + radius * std::cos(angle), center.y() + radius * std::sin(angle));
      }
      circle = withBody(press, circle, frame);
      plot.addLine(std::exchange(name, {}), circle.x, circle.y, appearance::curveColor(3));
    }
  }
}

} // namespace

std::unique_ptr<Plot> sectionPlot(vtkPalpDeformFilter& press, const Eigen::Vector3d& towards,
  const std::optional<SurfaceProfile>& elements, std::span<const PlacedNodule> nodules)
{
  auto plot = std::make_unique<Plot>(
    "section through the contact", "distance from the contact [mm]", "height [mm]");
  const PressRegion& region = press.GetDent().region();
  const Eigen::Vector3d center = region.toSurface(Eigen::Vector3d::Zero());
  const Eigen::Vector3d local = region.toLocal(center + towards);
  const int direction = static_cast<int>(std::lround(
                          diamondAngle(local.x(), local.y()) * PressField::kDirections / 4.0)) %
    PressField::kDirections;
  const Eigen::Vector2d edge = directionOf(4.0 * direction / PressField::kDirections);
  const Frame frame{ .center = center,
    .along = region.toSurface({ edge.x(), edge.y(), 0.0 }) - center,
    .up = region.normal() };

  const bool moves = press.GetPress().motion != nullptr;
  const Line tool = withBody(press, cutTool(press.GetPress(), frame), frame);
  const Cut cut = cutDent(press, frame);
  plot->addLine("tool", tool.x, tool.y, kToolLine, 4.0F);
  plot->addLine("surface at rest", cut.rest.x, cut.rest.y, appearance::curveColor(5));
  plot->addLine("surface as drawn", cut.drawn.x, cut.drawn.y, appearance::curveColor(1), 2.5F);
  if (!press.GetPress().fitted && !moves)
  {
    constexpr int kOpposite = PressField::kDirections / 2;
    Line control;
    addBezier(*plot, press.GetDent(), direction, 1.0, frame, cut, control);
    const int back = (direction + kOpposite) % PressField::kDirections;
    addBezier(*plot, press.GetDent(), back, -1.0, frame, cut, control);
    plot->addPoints("its control points", control.x, control.y, appearance::curveColor(0));
  }
  if (elements && !moves)
  {
    addElements(*plot, *elements, cut.rest);
  }
  addNodules(*plot, press, frame, nodules);
  return plot;
}

} // namespace palp
