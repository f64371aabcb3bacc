#include "pipeline/view/appearance.h"

#include "pipeline/color/even_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <locale>
#include <sstream>
#include <vtkActor2D.h>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkCellArray.h>
#include <vtkChartXY.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace palp::appearance
{
namespace
{

constexpr const char* kRegular = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr const char* kBold = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";

} // namespace

void setFont(vtkTextProperty& text, int size, const Color& color, bool bold)
{
  const char* file = bold ? kBold : kRegular;
  if (std::filesystem::exists(file))
  {
    text.SetFontFamily(VTK_FONT_FILE);
    text.SetFontFile(file);
  }
  text.SetBold(false); // the file is bold already
  text.SetItalic(false);
  text.SetShadow(false);
  text.SetFontSize(size);
  text.SetColor(color[0], color[1], color[2]);
}

vtkSmartPointer<vtkLookupTable> evenMapOn(const Color& base)
{
  constexpr int kColors = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kColors);
  for (int i = 0; i < kColors; ++i)
  {
    const Color color = color::evenMap(base, static_cast<double>(i) / (kColors - 1));
    table->SetTableValue(i, color[0], color[1], color[2]);
  }
  table->SetNanColor(kUnknown[0], kUnknown[1], kUnknown[2], 1.0);
  return table;
}

std::string fixedText(double value, int decimals)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(decimals);
  out << std::fixed << value;
  return out.str();
}

std::string roundText(double value)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(3);
  out << value;
  return out.str();
}

double roundUp(double value) noexcept
{
  if (!(value > 1e-12))
  {
    return 1.0;
  }
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : { 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0 })
  {
    if (value <= step * power * (1.0 + 1e-9))
    {
      return step * power;
    }
  }
  return 10.0 * power;
}

int decimalsOf(double round) noexcept
{
  constexpr int kMost = 12;
  double scaled = std::abs(round);
  int decimals = 0;
  while (decimals < kMost && std::abs(scaled - std::round(scaled)) > 1e-6 * scaled)
  {
    scaled *= 10.0;
    ++decimals;
  }
  return decimals;
}

void makeInkLine(vtkPolyData& line, vtkActor2D& actor, int points)
{
  vtkNew<vtkPoints> places;
  places->SetNumberOfPoints(points);
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(points);
  for (int i = 0; i < points; ++i)
  {
    cells->InsertCellPoint(i);
  }
  line.SetPoints(places);
  line.SetLines(cells);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(&line);
  actor.SetMapper(mapper);
  actor.GetProperty()->SetColor(kInk[0], kInk[1], kInk[2]);
}

void setColor(vtkProperty& property, const Color& color)
{
  property.SetColor(color[0], color[1], color[2]);
}

void drawInFront(vtkMapper& mapper)
{
  mapper.SetResolveCoincidentTopologyToPolygonOffset();
  mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(-2.0, -20.0);
  mapper.SetRelativeCoincidentTopologyLineOffsetParameters(-4.0, -200.0);
  mapper.SetRelativeCoincidentTopologyPointOffsetParameter(-200.0);
}

void setUpChart(
  vtkChartXY& chart, const std::string& title, const std::string& bottom, const std::string& left)
{
  chart.SetTitle(title);
  setFont(*chart.GetTitleProperties(), 15, kInk, true);
  chart.SetHiddenAxisBorder(title.empty() ? 14 : 28); // the title stays off the curves
  for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    vtkAxis* axis = chart.GetAxis(side);
    axis->SetTitle(side == vtkAxis::BOTTOM ? bottom : left);
    setFont(*axis->GetTitleProperties(), 13);
    setFont(*axis->GetLabelProperties(), 12);
    axis->GetGridPen()->SetColor(225, 228, 232);
  }
  chart.GetBackgroundBrush()->SetColor(255, 255, 255);
}

void setUpScene(vtkRenderer& renderer)
{
  renderer.SetBackground(kGround[0], kGround[1], kGround[2]);
  renderer.SetBackground2(kSky[0], kSky[1], kSky[2]);
  renderer.GradientBackgroundOn();

  struct Lamp
  {
    Eigen::Vector3d from; // right, up and towards the eye
    double intensity;
  };
  const std::array<Lamp, 3> lamps{ { { { -1.0, 0.75, 0.55 }, 0.95 },
    { { 0.7, -0.6, 1.0 }, 0.85 * 0.95 }, { { 0.3, 0.8, -0.9 }, 0.3 * 0.95 } } };
  renderer.AutomaticLightCreationOff();
  for (const Lamp& lamp : lamps)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(lamp.from.data());
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetIntensity(lamp.intensity);
    renderer.AddLight(light);
  }
}

vtkSmartPointer<vtkMatrix4x4> placement(const Eigen::Vector3d& origin, const Eigen::Matrix3d& axes)
{
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      matrix->SetElement(row, column, axes(row, column));
    }
    matrix->SetElement(row, 3, origin[row]);
  }
  return matrix;
}

Eigen::Matrix3d axesAlong(const Eigen::Vector3d& direction, int axis)
{
  const Eigen::Vector3d next = direction.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes.col(axis) = direction;
  axes.col((axis + 1) % 3) = next;
  axes.col((axis + 2) % 3) = direction.cross(next);
  return axes;
}

} // namespace palp::appearance
