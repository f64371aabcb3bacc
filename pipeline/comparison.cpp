#include "pipeline/comparison.h"

#include "haptics/units.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vtkCutter.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

constexpr double kNoticed = 0.07; // [-] of a force, Sec. 3.2
constexpr int kSteps = 200;

const appearance::Color& colorOf(std::size_t i)
{
  return appearance::kCurves[i % appearance::kCurves.size()];
}

std::vector<double> inMillimetres(std::vector<double> metres)
{
  std::transform(metres.begin(), metres.end(), metres.begin(), &units::toMillimetres);
  return metres;
}

std::vector<double> depthsTo(double deepest)
{
  std::vector<double> depths;
  for (int i = 0; i <= kSteps; ++i)
  {
    depths.push_back(deepest * i / kSteps);
  }
  return depths;
}

std::vector<double> forcesOf(const ForceLaw& law, const std::vector<double>& depths)
{
  std::vector<double> forces;
  for (const double depth : depths)
  {
    forces.push_back(law({ .depth = depth }).force);
  }
  return forces;
}

} // namespace

std::unique_ptr<Plot> forcePlot(
  const std::vector<NamedLaw>& laws, double deepest, const std::vector<ReferenceCurve>& references)
{
  auto plot = std::make_unique<Plot>("force over depth", "depth \u03b4 [mm]", "force [N]");
  const std::vector<double> depths = depthsTo(deepest);
  const std::vector<double> shown = inMillimetres(depths);
  const std::vector<double> first = forcesOf(laws.front().law, depths);
  const double margin = kNoticed * first.back();
  std::vector<double> low = first;
  std::vector<double> high = first;
  std::for_each(low.begin(), low.end(), [=](double& f) { f = std::max(0.0, f - margin); });
  std::for_each(high.begin(), high.end(), [=](double& f) { f += margin; });
  plot->addBand("7 % of the largest force", shown, low, high, colorOf(0));
  std::size_t color = 0;
  for (const NamedLaw& law : laws)
  {
    plot->addLine(law.name, shown, forcesOf(law.law, depths), colorOf(color++));
  }
  for (const ReferenceCurve& reference : references)
  {
    plot->addPoints(reference.name, inMillimetres(reference.x), reference.y, colorOf(color++));
  }
  return plot;
}

std::unique_ptr<Plot> forceErrorPlot(
  const NamedLaw& law, double deepest, const std::vector<ReferenceCurve>& references)
{
  auto plot = std::make_unique<Plot>(
    law.name + " against the references", "depth \u03b4 [mm]", "difference [%]");
  const std::vector<double> shown = inMillimetres(depthsTo(deepest));
  const std::vector<double> low(shown.size(), -100.0 * kNoticed);
  const std::vector<double> high(shown.size(), 100.0 * kNoticed);
  plot->addBand("just noticed by a hand", shown, low, high, colorOf(0));
  std::size_t color = 1;
  for (const ReferenceCurve& reference : references)
  {
    const double largest = *std::max_element(reference.y.begin(), reference.y.end());
    std::vector<double> error;
    for (std::size_t i = 0; i < reference.x.size(); ++i)
    {
      const double ours = law.law({ .depth = reference.x[i] }).force;
      error.push_back(100.0 * (ours - reference.y[i]) / largest);
    }
    plot->addLine(reference.name, inMillimetres(reference.x), error, colorOf(color++));
  }
  return plot;
}

std::unique_ptr<Plot> extentPlot(
  const ExtentTable& table, const std::vector<ReferenceCurve>& references)
{
  auto plot = std::make_unique<Plot>("extent over depth", "depth \u03b4 [mm]", "R_d [mm]");
  std::vector<double> depths;
  std::vector<double> radii;
  for (const ExtentTable::Row& row : table.rows())
  {
    depths.push_back(units::toMillimetres(row.depth));
    radii.push_back(units::toMillimetres(row.extentRadius));
  }
  // R_d = c1 depth + c2 depth^2 + c0 over the rows where there is one
  Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    const Eigen::Vector3d terms(1.0, depths[i], depths[i] * depths[i]);
    if (radii[i] > 0.0)
    {
      sums += terms * terms.transpose();
      right += radii[i] * terms;
    }
  }
  const Eigen::Vector3d fit = sums.completeOrthogonalDecomposition().solve(right);
  const std::vector<double> shown = inMillimetres(depthsTo(table.rows().back().depth));
  std::vector<double> line;
  std::vector<double> curve;
  for (const double depth : shown)
  {
    line.push_back(units::toMillimetres(table.extentRadius(units::fromMillimetres(depth))));
    curve.push_back(std::max(0.0, fit.dot(Eigen::Vector3d(1.0, depth, depth * depth))));
  }
  plot->addLine("table, linear in between", shown, line, colorOf(0));
  plot->addLine("quadratic fit", shown, curve, colorOf(1));
  plot->addPoints("table", depths, radii, colorOf(0));
  std::size_t color = 2;
  for (const ReferenceCurve& reference : references)
  {
    plot->addPoints(
      reference.name, inMillimetres(reference.x), inMillimetres(reference.y), colorOf(color++));
  }
  return plot;
}

std::unique_ptr<Plot> sectionPlot(vtkPalpDeformFilter& press, const Eigen::Vector3d& towards,
  const std::optional<ReferenceCurve>& reference)
{
  const Press& pressed = press.GetPress();
  const Eigen::Vector3d center = pressed.contact.center;
  const Eigen::Vector3d up = pressed.contact.normal;
  const Eigen::Vector3d along = (towards - towards.dot(up) * up).normalized();
  auto plot = std::make_unique<Plot>(
    "section through the contact", "distance from the contact [mm]", "height [mm]");

  vtkNew<vtkPlane> plane;
  plane->SetOrigin(center.data());
  plane->SetNormal(Eigen::Vector3d(up.cross(along)).data());
  vtkNew<vtkCutter> cutter;
  cutter->SetCutFunction(plane);
  cutter->SetInputConnection(press.GetOutputPort(1));
  cutter->Update();
  struct Cut
  {
    double x, drawn, rest; // [mm]
  };
  std::vector<Cut> cuts;
  vtkPolyData* lines = cutter->GetOutput();
  vtkDataArray* moved = lines->GetPointData()->GetArray("Displacement");
  for (vtkIdType i = 0; moved && i < lines->GetNumberOfPoints(); ++i)
  {
    Eigen::Vector3d point;
    Eigen::Vector3d displacement;
    lines->GetPoint(i, point.data());
    moved->GetTuple(i, displacement.data());
    const Eigen::Vector3d local = point - center;
    cuts.push_back({ units::toMillimetres(local.dot(along)), units::toMillimetres(local.dot(up)),
      units::toMillimetres((local - displacement).dot(up)) });
  }
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.x < b.x; });
  std::vector<double> x;
  std::vector<double> drawn;
  std::vector<double> rest;
  for (const Cut& cut : cuts)
  {
    x.push_back(cut.x);
    drawn.push_back(cut.drawn);
    rest.push_back(cut.rest);
  }

  const ToolBody body(pressed.tip, pressed.pose);
  const double base = baseRadius(pressed.tip);
  std::vector<double> toolX;
  std::vector<double> tool;
  for (int i = -kSteps; i <= kSteps; ++i)
  {
    const double radius = 0.9999 * base * i / kSteps;
    const double height = body.lowest(center + radius * along, up);
    if (std::isfinite(height) && height < base)
    {
      toolX.push_back(units::toMillimetres(radius));
      tool.push_back(units::toMillimetres(height));
    }
  }
  plot->addLine("tool", toolX, tool, { 0.45, 0.47, 0.50 }, 4.0F);
  plot->addLine("surface at rest", x, rest, colorOf(5));
  plot->addLine("surface as drawn", x, drawn, colorOf(1), 2.5F);
  if (reference)
  {
    plot->addLine(
      reference->name, inMillimetres(reference->x), inMillimetres(reference->y), colorOf(2));
  }
  return plot;
}

} // namespace palp
