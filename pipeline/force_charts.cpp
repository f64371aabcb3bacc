#include "pipeline/force_charts.h"

#include "haptics/units.h"
#include "pipeline/appearance.h"

#include <algorithm>
#include <cmath>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkFloatArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotPoints.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kFirstForce = 1.0; // [N], of the empty chart
constexpr double kFirstDepth = 5.0_mm;
constexpr double kFirstTime = 2.0; // [s]
constexpr int kLawPoints = 201;

void setPen(vtkPen& pen, const appearance::Color& color, float width)
{
  pen.SetColorF(color[0], color[1], color[2]);
  pen.SetWidth(width);
}

vtkPlot* addLine(vtkChartXY& chart, const char* name, const appearance::Color& color, float width)
{
  vtkPlot* line = chart.AddPlot(vtkChart::LINE);
  line->SetLabel(name);
  setPen(*line->GetPen(), color, width);
  return line;
}

void addLegend(vtkChartXY& chart)
{
  chart.SetShowLegend(true);
  chart.GetLegend()->SetHorizontalAlignment(vtkChartLegend::LEFT);
  chart.GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
  appearance::setFont(*chart.GetLegend()->GetLabelProperties(), 12);
}

// ranges come from refresh(), not from the plots
void fixAxes(vtkChartXY& chart)
{
  for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    chart.GetAxis(side)->SetBehavior(vtkAxis::FIXED);
  }
}

void setRange(vtkChartXY& chart, int side, double from, double to)
{
  vtkAxis* axis = chart.GetAxis(side);
  if (axis->GetMinimum() != from || axis->GetMaximum() != to)
  {
    axis->SetRange(from, to);
    axis->SetNumberOfTicks(-1);
    axis->AutoScale();
    axis->SetRange(from, to);
  }
}

// room above the largest value, in steps that do not change from frame to frame
double roomFor(double value, double least)
{
  const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-9) / 4.0)));
  const double mantissa = value / 4.0 / power;
  const double step = power * (mantissa <= 2.0 ? 2.0 : mantissa <= 5.0 ? 5.0 : 10.0);
  return std::max(least, step * std::ceil(1.05 * value / step));
}

} // namespace

ForceCharts::ForceCharts(std::optional<double> duration)
  : duration_(duration.value_or(0.0))
  , law_(SphereTip{ .radius = 10.0_mm }, Material{ .youngModulus = 50.0_kPa, .poissonRatio = 0.33 })
{
  const char* title = duration ? "force over time" : "force over the last minute";
  appearance::setUpChart(*overTime_, title, "time [s]", "force [N]");
  for (vtkPalpSampleSource* source : { samples_.Get(), rendered_.Get() })
  {
    source->SetSpan(std::max(duration_, vtkPalpSampleSource::Minute));
  }
  fixAxes(*overTime_);
  timePlot_ = addLine(*overTime_, "law", appearance::kLaw, 3.0F);
  renderedPlot_ = addLine(*overTime_, "rendered", appearance::kMeasured, 1.0F);
  addLegend(*overTime_);

  for (const char* name : { "depth [mm]", "force [N]" })
  {
    vtkNew<vtkFloatArray> column;
    column->SetName(name);
    column->SetNumberOfValues(kLawPoints);
    lawTable_->AddColumn(column);
  }
  appearance::setUpChart(*overDepth_, "force over depth", "depth \u03b4 [mm]", "force [N]");
  fixAxes(*overDepth_);
  addLine(*overDepth_, "law", appearance::kLaw, 5.0F)->SetInputData(lawTable_, 0, 1);
  auto* points = vtkPlotPoints::SafeDownCast(overDepth_->AddPlot(vtkChart::POINTS));
  points->SetLabel("measured");
  points->SetMarkerStyle(vtkPlotPoints::CIRCLE);
  points->SetMarkerSize(3.0F);
  setPen(*points->GetPen(), appearance::kMeasured, 1.0F);
  depthPlot_ = points;
  addLegend(*overDepth_);
  setLaw(law_);
}

void ForceCharts::addForceOverTime(vtkContextScene& scene)
{
  scene.AddItem(overTime_);
}

void ForceCharts::addForceOverDepth(vtkContextScene& scene)
{
  scene.AddItem(overDepth_);
}

void ForceCharts::add(const Sample& sample)
{
  samples_->AddSample(sample);
  Sample sent = sample;
  sent.response.force = sample.force.norm();
  rendered_->AddSample(sent);
  if (std::isfinite(sample.response.force) && std::isfinite(sample.contact.depth))
  {
    largestForce_ = std::max(largestForce_, sample.response.force);
    largestDepth_ = std::max(largestDepth_, sample.contact.depth);
  }
}

void ForceCharts::refresh()
{
  // a plot knows tables, not connections
  samples_->Update();
  rendered_->Update();
  timePlot_->SetInputData(samples_->GetOutput(0), 0, 1);
  depthPlot_->SetInputData(samples_->GetOutput(1), 0, 1);
  renderedPlot_->SetInputData(rendered_->GetOutput(0), 0, 1);
  for (vtkPlot* plot : { timePlot_, renderedPlot_ })
  {
    plot->SetVisible(samples_->GetOutput(0)->GetNumberOfRows() > 1); // else VTK complains
  }
  const double depthLimit = units::fromMillimetres(
    roomFor(units::toMillimetres(largestDepth_), units::toMillimetres(kFirstDepth)));
  if (depthLimit != lawLimit_)
  {
    drawLaw(depthLimit);
  }
  const double law = law_({ .depth = depthLimit }).force;
  const double last = samples_->GetLastTime();
  const double span = samples_->GetSpan();
  const double end = duration_ > 0.0 ? duration_
    : last < span                    ? std::min(span, roomFor(last, kFirstTime))
                                     : last;
  setRange(*overTime_, vtkAxis::BOTTOM, std::max(0.0, end - span), end);
  setRange(*overTime_, vtkAxis::LEFT, 0.0, roomFor(largestForce_, kFirstForce));
  setRange(*overDepth_, vtkAxis::BOTTOM, 0.0, units::toMillimetres(depthLimit));
  setRange(*overDepth_, vtkAxis::LEFT, 0.0, roomFor(std::max(largestForce_, law), law));
}

void ForceCharts::clear()
{
  samples_->Clear();
  rendered_->Clear();
  largestForce_ = 0.0;
  largestDepth_ = 0.0;
}

void ForceCharts::setLaw(const ForceLaw& law)
{
  law_ = law;
  lawLimit_ = 0.0;
  refresh();
}

void ForceCharts::drawLaw(double depthLimit)
{
  lawLimit_ = depthLimit;
  for (vtkIdType i = 0; i < kLawPoints; ++i)
  {
    const double depth = depthLimit * static_cast<double>(i) / (kLawPoints - 1);
    lawTable_->SetValue(i, 0, units::toMillimetres(depth));
    lawTable_->SetValue(i, 1, law_({ .depth = depth }).force);
  }
  lawTable_->GetColumn(0)->Modified();
  lawTable_->GetColumn(1)->Modified();
  lawTable_->Modified();
}

} // namespace palp
