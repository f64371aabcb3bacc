#include "haptics/units.h"
#include "pipeline/charts/comparison.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vtkCutter.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

constexpr int kSteps = 200;
constexpr appearance::Color kToolLine{ 0.45, 0.47, 0.50 };

struct Line
{
  std::vector<double> x; // [mm] from the contact's centre
  std::vector<double> y; // [mm] along the normal

  void add(double along, double up)
  {
    x.push_back(units::toMillimetres(along));
    y.push_back(units::toMillimetres(up));
  }
};

// the plane of the cut
struct Frame
{
  Eigen::Vector3d center;
  Eigen::Vector3d along;
  Eigen::Vector3d up;
};

// what is drawn, and where it was at rest, from left to right
struct Cut
{
  Line drawn;
  Line rest;
};

Cut cutDent(vtkPalpDeformFilter& press, const Frame& frame)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(frame.center.data());
  plane->SetNormal(Eigen::Vector3d(frame.up.cross(frame.along)).data());
  vtkNew<vtkCutter> cutter;
  cutter->SetCutFunction(plane);
  cutter->SetInputConnection(press.GetOutputPort(1));
  cutter->Update();
  vtkPolyData* lines = cutter->GetOutput();
  vtkDataArray* moved = lines->GetPointData()->GetArray("Displacement");
  struct Point
  {
    double along, drawn, rest; // [m]
  };
  std::vector<Point> points;
  for (vtkIdType i = 0; moved && i < lines->GetNumberOfPoints(); ++i)
  {
    Eigen::Vector3d point;
    Eigen::Vector3d displacement;
    lines->GetPoint(i, point.data());
    moved->GetTuple(i, displacement.data());
    point -= frame.center;
    points.push_back(
      { point.dot(frame.along), point.dot(frame.up), (point - displacement).dot(frame.up) });
  }
  std::sort(
    points.begin(), points.end(), [](const Point& a, const Point& b) { return a.along < b.along; });
  Cut cut;
  for (const Point& point : points)
  {
    cut.drawn.add(point.along, point.drawn);
    cut.rest.add(point.along, point.rest);
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

// the curve of a patch's edge on one side, laid as it is over the surface at rest
void addBezier(Plot& plot, const Dent& dent, int direction, double side, const Frame& frame,
  const Line& rest, Line& control)
{
  const RingCurve& ring = dent.field().curve(direction);
  const std::array<std::pair<double, double>, 3> sinks{ std::pair(ring.inner, ring.sink),
    std::pair(ring.meet, 0.0), std::pair(ring.outer, 0.0) };
  Line curve;
  const std::size_t count = rest.x.size();
  double last = 0.0; // distance [m] of the point before
  std::size_t next = 0;
  for (std::size_t i = 0; i < count && next < sinks.size(); ++i)
  {
    const std::size_t at = side > 0.0 ? i : count - 1 - i; // outwards
    const std::size_t before = i == 0 ? at : (side > 0.0 ? at - 1 : at + 1);
    const double along = units::fromMillimetres(rest.x[at]);
    const double up = units::fromMillimetres(rest.y[at]);
    if (side * along < 0.0)
    {
      continue;
    }
    const double distance =
      dent.region().placeInFront(frame.center + along * frame.along + up * frame.up).distance;
    for (; next < sinks.size() && distance >= sinks[next].first; ++next)
    {
      const double t = (sinks[next].first - last) / std::max(distance - last, 1e-12);
      control.x.push_back(rest.x[before] + t * (rest.x[at] - rest.x[before]));
      control.y.push_back(rest.y[before] + t * (rest.y[at] - rest.y[before]) -
        units::toMillimetres(sinks[next].second));
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
      const double radius = side * units::fromMillimetres(rest.x[i]);
      if (radius >= elements.inner)
      {
        line.add(side * radius, units::fromMillimetres(rest.y[i]) - elements.sinkAt(radius));
      }
    }
    plot.addLine(side < 0.0 ? "finite elements, on a plane" : "", line.x, line.y,
      appearance::curveColor(2), 2.0F, true);
  }
}

} // namespace

std::unique_ptr<Plot> sectionPlot(vtkPalpDeformFilter& press, const Eigen::Vector3d& towards,
  const std::optional<SurfaceProfile>& elements)
{
  auto plot = std::make_unique<Plot>(
    "section through the contact", "distance from the contact [mm]", "height [mm]");
  const PressRegion& region = press.GetDent().region();
  const Eigen::Vector3d center = region.toSurface(Eigen::Vector3d::Zero());
  const Eigen::Vector3d local = region.toLocal(center + towards);
  const int direction = static_cast<int>(std::lround(
                          quarterTurns(local.x(), local.y()) * PressField::kDirections / 4.0)) %
    PressField::kDirections;
  const Eigen::Vector2d edge = directionOf(4.0 * direction / PressField::kDirections);
  const Frame frame{ .center = center,
    .along = region.toSurface({ edge.x(), edge.y(), 0.0 }) - center,
    .up = region.normal() };

  const Line tool = cutTool(press.GetPress(), frame);
  const Cut cut = cutDent(press, frame);
  plot->addLine("tool", tool.x, tool.y, kToolLine, 4.0F);
  plot->addLine("surface at rest", cut.rest.x, cut.rest.y, appearance::curveColor(5));
  plot->addLine("surface as drawn", cut.drawn.x, cut.drawn.y, appearance::curveColor(1), 2.5F);
  if (!press.GetPress().fitted)
  {
    constexpr int kOpposite = PressField::kDirections / 2;
    Line control;
    addBezier(*plot, press.GetDent(), direction, 1.0, frame, cut.rest, control);
    const int back = (direction + kOpposite) % PressField::kDirections;
    addBezier(*plot, press.GetDent(), back, -1.0, frame, cut.rest, control);
    plot->addPoints("its control points", control.x, control.y, appearance::curveColor(0));
  }
  if (elements)
  {
    addElements(*plot, *elements, cut.rest);
  }
  return plot;
}

} // namespace palp
