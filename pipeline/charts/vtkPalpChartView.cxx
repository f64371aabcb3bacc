// What of a vtkPalpChart is looked at: ranges of its axes, curves that are shown, values.

#include "pipeline/charts/curve_reading.h"
#include "pipeline/charts/vtkPalpChart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotArea.h>
#include <vtkPlotLine.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

namespace
{

void setRange(vtkAxis& axis, double from, double to)
{
  if (axis.GetMinimum() != from || axis.GetMaximum() != to)
  {
    axis.SetRange(from, to);
    axis.SetNumberOfTicks(-1);
    axis.AutoScale(); // the ticks; it also widens the range
    axis.SetRange(from, to);
  }
}

double lengthOf(vtkAxis& axis)
{
  const double across = axis.GetPoint2()[0] - axis.GetPoint1()[0];
  const double up = axis.GetPoint2()[1] - axis.GetPoint1()[1];
  return std::max(1.0, std::hypot(across, up));
}

// at round numbers, some pixels apart at least; how many letters the longest of these has
std::size_t setTicks(vtkAxis& axis, double apart)
{
  double low = axis.GetMinimum();
  double high = axis.GetMaximum();
  const double first = low;
  const double last = high;
  const double step =
    vtkAxis::NiceMinMax(low, high, static_cast<float>(lengthOf(axis)), static_cast<float>(apart));
  constexpr double kRounding = 1e-9; // of a step
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  std::size_t longest = 0;
  for (double i = std::ceil(first / step - kRounding) + 0.0; // which is no -0
       i * step <= last + kRounding * step; ++i)
  {
    std::string label = palp::readingText(i * step, step);
    if (label.find('.') != label.npos)
    {
      label.erase(label.find_last_not_of('0') + 1); // 0.5, 1, 1.5
      label.erase(label.find_last_not_of('.') + 1);
    }
    positions->InsertNextValue(i * step);
    labels->InsertNextValue(label);
    longest = std::max(longest, label.size());
  }
  axis.SetCustomTickPositions(positions, labels);
  return longest;
}

std::vector<double> columnOf(vtkTable& table, vtkIdType column)
{
  auto* array = vtkDataArray::SafeDownCast(table.GetColumn(column));
  std::vector<double> values(static_cast<std::size_t>(array ? table.GetNumberOfRows() : 0));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = array->GetTuple1(static_cast<vtkIdType>(i));
  }
  return values;
}

double pixelOf(vtkAxis& axis)
{
  return std::abs(axis.GetMaximum() - axis.GetMinimum()) / lengthOf(axis);
}

} // namespace

void vtkPalpChart::SetFollowed(int side, double from, double to)
{
  View& view = this->Views[static_cast<std::size_t>(side)];
  view.Followed = { from, to };
  if (!view.Held)
  {
    this->GetAxis(side)->SetBehavior(vtkAxis::FIXED);
    setRange(*this->GetAxis(side), from, to);
  }
}

void vtkPalpChart::Hold(int side, double from, double to)
{
  vtkAxis& axis = *this->GetAxis(side);
  // closer than this the numbers at an axis are all alike
  const double least = 1e-9 * std::max({ 1.0, std::abs(from), std::abs(to) });
  if (axis.GetLogScaleActive() || !(to - from > least) || !std::isfinite(to - from))
  {
    return;
  }
  View& view = this->Views[static_cast<std::size_t>(side)];
  if (!view.Held)
  {
    view.Behavior = axis.GetBehavior();
  }
  view.Held = { from, to };
  axis.SetBehavior(vtkAxis::FIXED);
  setRange(axis, from, to);
}

void vtkPalpChart::Follow(int side)
{
  View& view = this->Views[static_cast<std::size_t>(side)];
  if (!view.Held)
  {
    return;
  }
  view.Held.reset();
  this->GetAxis(side)->SetBehavior(view.Followed ? vtkAxis::FIXED : view.Behavior);
  if (view.Followed)
  {
    setRange(*this->GetAxis(side), view.Followed->first, view.Followed->second);
  }
  this->RecalculateBounds();
}

void vtkPalpChart::FollowData()
{
  this->Follow(vtkAxis::BOTTOM);
  this->Follow(vtkAxis::LEFT);
}

bool vtkPalpChart::IsHeld(int side) const
{
  return this->Views[static_cast<std::size_t>(side)].Held.has_value();
}

void vtkPalpChart::SetCurveShown(const std::string& label, bool shown)
{
  shown ? static_cast<void>(this->Hidden.erase(label))
        : static_cast<void>(this->Hidden.insert(label));
  this->ShowCurves();
  this->RecalculateBounds();
}

bool vtkPalpChart::IsCurveShown(const std::string& label) const
{
  return !this->Hidden.contains(label);
}

void vtkPalpChart::ToggleCurveAt(const vtkVector2f& at)
{
  for (const auto& [label, box] : this->Names)
  {
    if (at[0] >= box.GetLeft() && at[0] <= box.GetRight() && at[1] >= box.GetBottom() &&
      at[1] <= box.GetTop())
    {
      this->SetCurveShown(label, !this->IsCurveShown(label));
      return;
    }
  }
}

void vtkPalpChart::SpaceTicks()
{
  for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    // [pixels] as the toolkit's own, where letters are as on a screen
    const double least = side == vtkAxis::LEFT ? 30.0 : 45.0;
    const double letter = side == vtkAxis::LEFT ? 0.0 : 8.0; // of a number
    vtkAxis& axis = *this->GetAxis(side);
    std::size_t letters = 0;
    std::size_t longest = 5; // about
    while (longest > letters && !axis.GetLogScaleActive())
    {
      letters = longest;
      longest =
        setTicks(axis, this->Scale * std::max(least, letter * static_cast<double>(letters)));
    }
  }
}

void vtkPalpChart::TakeViewOf(const vtkPalpChart& other)
{
  this->Hidden = other.Hidden;
  for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    if (const auto& held = other.Views[static_cast<std::size_t>(side)].Held)
    {
      this->Hold(side, held->first, held->second);
    }
  }
}

// a line of one point would be complained of at every picture
void vtkPalpChart::ShowCurves()
{
  bool isShown = true;
  for (vtkIdType i = 0; i < this->GetNumberOfPlots(); ++i)
  {
    vtkPlot* plot = this->GetPlot(i);
    isShown = plot->GetLabel().empty() ? isShown : this->IsCurveShown(plot->GetLabel());
    const vtkTable* table = plot->GetInput();
    const bool isLine = vtkPlotLine::SafeDownCast(plot) || vtkPlotArea::SafeDownCast(plot);
    const vtkIdType rows = table ? const_cast<vtkTable*>(table)->GetNumberOfRows() : 0;
    plot->SetVisible(isShown && rows > (isLine ? 1 : 0));
  }
}

std::vector<vtkPalpChart::Reading> vtkPalpChart::ReadingsAt(double x, double y)
{
  constexpr double kReach = 8.0; // [pixels] of a point
  const double across = pixelOf(*this->GetAxis(vtkAxis::BOTTOM));
  const double up = pixelOf(*this->GetAxis(vtkAxis::LEFT));
  std::vector<Reading> readings;
  for (vtkIdType i = 0; i < this->GetNumberOfPlots(); ++i)
  {
    vtkPlot* plot = this->GetPlot(i);
    if (!plot->GetVisible() || plot->GetInput()->GetNumberOfColumns() != 2)
    {
      continue; // a band has two values
    }
    const std::vector<double> at = columnOf(*plot->GetInput(), 0);
    const std::vector<double> values = columnOf(*plot->GetInput(), 1);
    std::optional<double> value;
    if (vtkPlotLine::SafeDownCast(plot))
    {
      value = palp::valueOfLine(at, values, x, y);
    }
    else
    {
      // at the line, as its value is told there; of several, the one nearest to the pointer
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      std::pair nearest(kReach, kInfinity);
      for (std::size_t k = 0; k < at.size(); ++k)
      {
        const std::pair away(
          std::max(1.0, std::abs(at[k] - x) / across), std::abs(values[k] - y) / up);
        if (away < nearest)
        {
          nearest = away;
          value = values[k];
        }
      }
    }
    if (value)
    {
      readings.push_back({ plot->GetLabel(), plot->GetPen()->GetColorObject(), *value });
    }
  }
  return readings;
}

std::string vtkPalpChart::ReadingOf(int side, double value)
{
  vtkAxis& axis = *this->GetAxis(side);
  const double shown = axis.GetLogScaleActive() ? std::pow(10.0, value) : value;
  const double step = axis.GetLogScaleActive() ? 0.01 * shown : pixelOf(axis);
  return palp::readingText(shown, step) + ' ' + palp::unitOf(axis.GetTitle());
}
