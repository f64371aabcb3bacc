#include "pipeline/view/appearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <locale>
#include <sstream>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkColorTransferFunction.h>
#include <vtkLookupTable.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

namespace palp::appearance
{
namespace
{

// the map at 0, 0.1 ... 1
constexpr std::array<Color, 11> kViridis{ {
  { 0.267004, 0.004874, 0.329415 },
  { 0.282623, 0.140926, 0.457517 },
  { 0.253935, 0.265254, 0.529983 },
  { 0.206756, 0.371758, 0.553117 },
  { 0.163625, 0.471133, 0.558148 },
  { 0.127568, 0.566949, 0.550556 },
  { 0.134692, 0.658636, 0.517649 },
  { 0.266941, 0.748751, 0.440573 },
  { 0.477504, 0.821444, 0.318195 },
  { 0.741388, 0.873449, 0.149561 },
  { 0.993248, 0.906157, 0.143936 },
} };

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

vtkSmartPointer<vtkLookupTable> viridisOn(const Color& base)
{
  vtkNew<vtkColorTransferFunction> function;
  for (std::size_t i = 0; i < kViridis.size(); ++i)
  {
    const double at = static_cast<double>(i) / (kViridis.size() - 1);
    function->AddRGBPoint(at, kViridis[i][0], kViridis[i][1], kViridis[i][2]);
  }
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  constexpr int kColors = 256;
  constexpr double kFadeIn = 0.06; // [-] of the range
  table->SetNumberOfTableValues(kColors);
  for (int i = 0; i < kColors; ++i)
  {
    Color color{};
    function->GetColor(static_cast<double>(i) / (kColors - 1), color.data());
    const double fraction = std::min(1.0, i / (kFadeIn * (kColors - 1)));
    for (std::size_t k = 0; k < color.size(); ++k)
    {
      color[k] = base[k] + fraction * (color[k] - base[k]);
    }
    table->SetTableValue(i, color[0], color[1], color[2]);
  }
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
