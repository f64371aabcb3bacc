#include "pipeline/charts/plot.h"

#include "haptics/files/csv_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkStringArray.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

int styleOf(Plot::Mark mark)
{
  switch (mark)
  {
    case Plot::Mark::Square:
      return vtkPlotPoints::SQUARE;
    case Plot::Mark::Diamond:
      return vtkPlotPoints::DIAMOND;
    default:
      return vtkPlotPoints::CIRCLE;
  }
}

// 10 to an integer power, as people write it
std::string powerOfTen(int exponent)
{
  static constexpr std::array kDigits{ "\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074", "\u2075",
    "\u2076", "\u2077", "\u2078", "\u2079" };
  std::string text = exponent < 0 ? "10\u207b" : "10";
  for (const char digit : std::to_string(std::abs(exponent)))
  {
    text += kDigits[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

} // namespace

Plot::Plot(const std::string& title, const std::string& bottom, const std::string& left)
  : bottom_(bottom)
  , left_(left)
{
  appearance::setUpChart(*chart_, title, bottom, left);
  vtkAxis* vertical = chart_->GetAxis(vtkAxis::LEFT);
  vertical->SetLabelOffset(4.0F); // or the labels touch the title
  vertical->SetTickLength(3.0F);
}

vtkTable* Plot::addTable(const std::string& name, std::span<const double> x,
  std::span<const double> first, std::span<const double> second)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  const auto addColumn = [&](const std::string& column, std::span<const double> values)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(column.c_str());
    for (const double value : values)
    {
      array->InsertNextValue(value);
    }
    table->AddColumn(array);
  };
  addColumn(bottom_, x);
  addColumn(second.empty() ? name : name + ", lower", first);
  if (!second.empty())
  {
    addColumn(name + ", upper", second);
  }
  tables_.push_back(table);
  return table;
}

void Plot::add(const Curve& curve, std::span<const double> x, std::span<const double> first,
  std::span<const double> second)
{
  static constexpr std::array kTypes{ vtkChart::LINE, vtkChart::POINTS, vtkChart::AREA };
  const auto& [red, green, blue] = curve.color;
  vtkTable* table = addTable(curve.name, x, first, second);
  curves_.push_back(curve);
  vtkPlot* plot = chart_->AddPlot(kTypes[static_cast<std::size_t>(curve.kind)]);
  plot->SetInputData(table, 0, 1);
  plot->SetLabel(curve.name);
  plot->GetPen()->SetColorF(red, green, blue);
  switch (curve.kind)
  {
    case Curve::Kind::Line:
      plot->SetWidth(curve.size);
      plot->GetPen()->SetLineType(curve.style);
      break;
    case Curve::Kind::Points:
      vtkPlotPoints::SafeDownCast(plot)->SetMarkerStyle(styleOf(static_cast<Mark>(curve.style)));
      vtkPlotPoints::SafeDownCast(plot)->SetMarkerSize(curve.size);
      break;
    case Curve::Kind::Band:
      for (int column = 0; column < 3; ++column)
      {
        plot->SetInputArray(column, table->GetColumnName(column));
      }
      plot->GetBrush()->SetColorF(red, green, blue, 0.25);
      plot->GetPen()->SetLineType(vtkPen::NO_PEN);
      break;
  }
}

void Plot::addLine(const std::string& name, std::span<const double> x, std::span<const double> y,
  const appearance::Color& color, float width, appearance::LineStyle style)
{
  add({ Curve::Kind::Line, name, color, width, static_cast<int>(style) }, x, y);
}

void Plot::addPoints(const std::string& name, std::span<const double> x, std::span<const double> y,
  const appearance::Color& color, Mark mark, float size)
{
  add({ Curve::Kind::Points, name, color, size, static_cast<int>(mark) }, x, y);
}

void Plot::addBand(const std::string& name, std::span<const double> x, std::span<const double> low,
  std::span<const double> high, const appearance::Color& color)
{
  add({ .kind = Curve::Kind::Band, .name = name, .color = color }, x, low, high);
}

std::pair<double, double> Plot::rangeOf(bool isBottom) const
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& table : tables_)
  {
    for (vtkIdType column = isBottom ? 0 : 1; column < (isBottom ? 1 : table->GetNumberOfColumns());
         ++column)
    {
      for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
      {
        low = std::min(low, table->GetValue(row, column).ToDouble());
        high = std::max(high, table->GetValue(row, column).ToDouble());
      }
    }
  }
  return { low, high };
}

void Plot::setDecades(vtkAxis& axis, bool isBottom)
{
  const auto [low, high] = rangeOf(isBottom);
  if (!(low > 0.0 && high >= low && high < std::numeric_limits<double>::infinity()))
  {
    return; // nothing there, or nothing that has a logarithm
  }
  constexpr double kMargin = 0.05; // of a decade, so that no mark lies on the border
  const auto first = static_cast<int>(std::floor(std::log10(low) - kMargin));
  const auto last = static_cast<int>(std::ceil(std::log10(high) + kMargin));
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  const int step = last - first > 9 ? 2 : 1;
  for (int exponent = first; exponent <= last; exponent += step)
  {
    positions->InsertNextValue(exponent);
    labels->InsertNextValue(powerOfTen(exponent));
  }
  axis.SetLogScale(true);
  axis.SetBehavior(vtkAxis::FIXED);
  axis.SetUnscaledRange(std::pow(10.0, first), std::pow(10.0, last));
  axis.SetCustomTickPositions(positions, labels);
}

void Plot::setLogarithmic(bool bottom, bool left)
{
  if (bottom)
  {
    setDecades(*chart_->GetAxis(vtkAxis::BOTTOM), true);
  }
  if (left)
  {
    setDecades(*chart_->GetAxis(vtkAxis::LEFT), false);
  }
}

void Plot::keepMarksWhole()
{
  constexpr double kMargin = 0.04; // of the range, more than half a mark
  for (const bool isBottom : { true, false })
  {
    const auto [low, high] = rangeOf(isBottom);
    const double margin = high > low ? kMargin * (high - low) : 1.0;
    if (std::isfinite(low) && std::isfinite(high))
    {
      vtkAxis* axis = chart_->GetAxis(isBottom ? vtkAxis::BOTTOM : vtkAxis::LEFT);
      axis->SetBehavior(vtkAxis::FIXED);
      axis->SetUnscaledRange(low - margin, high + margin);
    }
  }
}

void Plot::hideLegend()
{
  chart_->SetKeyed(false);
}

void Plot::addTo(vtkContextScene& scene)
{
  scene.AddItem(chart_);
}

void Plot::addTo(vtkContextScene& scene, double bottom, double top)
{
  chart_->SetShare(bottom, top);
  addTo(scene);
}

void Plot::setNote(const std::string& note)
{
  note_ = note;
}

void Plot::writeCsv(std::ostream& out) const
{
  out << (note_.empty() ? "" : "# " + note_ + '\n');
  out << "curve," << bottom_ << ',' << left_ << '\n';
  std::string name;
  for (const auto& table : tables_)
  {
    for (vtkIdType column = 1; column < table->GetNumberOfColumns(); ++column)
    {
      const std::string own = table->GetColumnName(column);
      name = own.empty() ? name : own; // a part without a name goes on with the curve before
      for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
      {
        out << '"' << name << "\"," << shortest(table->GetValue(row, 0).ToDouble()) << ','
            << shortest(table->GetValue(row, column).ToDouble()) << '\n';
      }
    }
  }
}

vtkContextScene* showEmptyScene(vtkRenderWindow& window)
{
  window.GetRenderers()->RemoveAllItems();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->SetRenderer(renderer);
  renderer->AddActor(actor);
  window.AddRenderer(renderer);
  return actor->GetScene();
}

vtkContextScene* showPlots(vtkRenderWindow& window, std::span<const std::unique_ptr<Plot>> plots)
{
  // in one scene, for the exporter of lines and text knows no other place than the whole window
  vtkContextScene* scene = showEmptyScene(window);
  constexpr double kFirst = 0.6; // of the height
  double top = 1.0;
  for (const auto& plot : plots)
  {
    const double bottom = &plot == &plots.back() ? 0.0 : (1.0 - kFirst) * top;
    plot->addTo(*scene, bottom, top);
    top = bottom;
  }
  return scene;
}

} // namespace palp
