#include "pipeline/charts/force_charts.h"

#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <span>
#include <utility>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotPoints.h>
#include <vtkTextProperty.h>
#include <vtkVariant.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kFirstForce = 1.0;  // [N], of the empty chart
constexpr double kLeastForce = 0.05; // [N], of one with a press
constexpr double kFirstDepth = 5.0_mm;
constexpr double kFirstTime = 2.0; // [s]
constexpr int kLawPoints = 201;
constexpr float kMark = 9.0F; // [pixels]
constexpr float kPressWidth = 2.0F;

constexpr const char* kOverTime = "force over time";
constexpr const char* kOverDepth = "force over depth";
constexpr const char* kTime = "time [s]";
constexpr const char* kDepth = "depth \u03b4 [mm]";
constexpr const char* kForce = "force [N]";
constexpr const char* kSent = "sent to device";

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

// empty
void addColumns(vtkTable& table, std::initializer_list<const char*> names)
{
  for (const char* name : names)
  {
    vtkNew<vtkFloatArray> column;
    column->SetName(name);
    table.AddColumn(column);
  }
}

vtkPlotPoints* addPoints(
  vtkChartXY& chart, const char* name, const appearance::Color& color, float size)
{
  auto* points = vtkPlotPoints::SafeDownCast(chart.AddPlot(vtkChart::POINTS));
  points->SetLabel(name);
  points->SetMarkerStyle(vtkPlotPoints::CIRCLE);
  points->SetMarkerSize(size);
  setPen(*points->GetPen(), color, 1.0F);
  return points;
}

// room above the largest value, in steps that do not change from frame to frame
double roomFor(double value, double least)
{
  const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-9) / 4.0)));
  const double mantissa = value / 4.0 / power;
  const double step = power * (mantissa <= 2.0 ? 2.0 : mantissa <= 5.0 ? 5.0 : 10.0);
  return std::max(least, step * std::ceil(1.05 * value / step));
}

// a float as people write it, 0.1125 for 0.11249999701976776
double inDecimals(float value)
{
  std::array<char, 32> text{};
  const char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double decimals = value;
  (void)std::from_chars(text.data(), end, decimals);
  return decimals;
}

double largestOf(std::span<const double> values)
{
  return values.empty() ? 0.0 : std::ranges::max(values);
}

std::vector<double> columnOf(vtkTable& table, vtkIdType column)
{
  std::vector<double> values;
  for (vtkIdType row = 0; row < table.GetNumberOfRows(); ++row)
  {
    const vtkVariant value = table.GetValue(row, column);
    values.push_back(value.IsFloat() ? inDecimals(value.ToFloat()) : value.ToDouble());
  }
  return values;
}

// of a column; 0 of an empty one
double largest(vtkTable& table, vtkIdType column)
{
  double range[2]{ 0.0, 0.0 };
  if (table.GetNumberOfRows() > 0)
  {
    vtkDataArray::SafeDownCast(table.GetColumn(column))->GetRange(range);
  }
  return range[1];
}

} // namespace

ForceCharts::ForceCharts(std::optional<double> duration)
  : duration_(duration.value_or(0.0))
  , law_(SphereTip{ .radius = 10.0_mm }, Material{ .youngModulus = 50.0_kPa, .poissonRatio = 0.33 })
{
  appearance::setUpChart(*overTime_, duration ? kOverTime : "", kTime, kForce);
  for (vtkPalpSampleSource* source : { samples_.Get(), rendered_.Get() })
  {
    source->SetSpan(std::max(duration_, vtkPalpSampleSource::Minute));
  }
  timePlot_ = addLine(*overTime_, "model", appearance::kLaw, 3.0F);
  renderedPlot_ = addLine(*overTime_, "", appearance::kMeasured, 1.0F);

  addColumns(*lawTable_, { "depth [mm]", "force [N]" });
  lawTable_->SetNumberOfRows(kLawPoints);
  appearance::setUpChart(*overDepth_, duration ? kOverDepth : "", kDepth, kForce);
  lawPlot_ = addLine(*overDepth_, "", appearance::kLaw, 5.0F);
  lawPlot_->SetInputData(lawTable_, 0, 1);
  depthPlot_ = addPoints(*overDepth_, "recorded", appearance::kMeasured, 3.0F);

  addColumns(*marked_, { "time [s]", "depth [mm]", "force [N]" });
  addPoints(*overTime_, "", appearance::kInk, kMark)->SetInputData(marked_, 0, 2);
  addPoints(*overDepth_, "", appearance::kInk, kMark)->SetInputData(marked_, 1, 2);
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

void ForceCharts::setSent(bool isSent)
{
  isSent_ = isSent;
  renderedPlot_->SetLabel(isSent ? kSent : ""); // without one it has no entry in the legend
}

void ForceCharts::add(const Sample& sample)
{
  samples_->AddSample(sample);
  if (isSent_)
  {
    Sample sent = sample;
    sent.response.force = sample.force.norm();
    rendered_->AddSample(sent);
  }
}

void ForceCharts::refresh()
{
  if (!isPaused_)
  {
    update();
  }
}

void ForceCharts::update()
{
  drawPresses();
  const double first = duration_ > 0.0 ? 0.0 : std::floor(samples_->GetFirstTime());
  const double past = samples_->GetLastTime() - first;
  const double span = samples_->GetSpan();
  const double end = duration_ > 0.0 ? duration_
    : past < span                    ? first + std::min(span, roomFor(past, kFirstTime))
                                     : first + past;
  overTime_->SetFollowed(vtkAxis::BOTTOM, std::max(first, end - span), end);
  vtkAxis& time = *overTime_->GetAxis(vtkAxis::BOTTOM);
  for (vtkPalpSampleSource* source : { samples_.Get(), rendered_.Get() })
  {
    source->LookAt(time.GetMinimum(), time.GetMaximum());
  }
  // a plot knows tables, not connections
  samples_->Update();
  rendered_->Update();
  timePlot_->SetInputData(samples_->GetOutput(0), 0, 1);
  depthPlot_->SetInputData(samples_->GetOutput(1), 0, 1);
  renderedPlot_->SetInputData(rendered_->GetOutput(0), 0, 1);
  const double force =
    std::max(largest(*samples_->GetOutput(0), 1), largest(*rendered_->GetOutput(0), 1));
  const double depthLimit =
    units::fromMillimeters(roomFor(deepest(), units::toMillimeters(kFirstDepth)));
  if (depthLimit != lawLimit_)
  {
    drawLaw(depthLimit);
  }
  const double law = law_({ .depth = depthLimit }).force;
  overTime_->SetFollowed(
    vtkAxis::LEFT, 0.0, force > 0.0 ? roomFor(force, kLeastForce) : kFirstForce);
  overDepth_->SetFollowed(vtkAxis::BOTTOM, 0.0, units::toMillimeters(depthLimit));
  double most = std::max(largest(*samples_->GetOutput(1), 1), law);
  for (const PressCurve& press : presses_)
  {
    most = std::max(most, largestOf(press.forces));
  }
  overDepth_->SetFollowed(vtkAxis::LEFT, 0.0, roomFor(most, law));
}

// of all that is drawn over depth [mm]
double ForceCharts::deepest() const
{
  double depth = largest(*samples_->GetOutput(1), 0);
  for (const PressCurve& press : presses_)
  {
    depth = std::max(depth, units::toMillimeters(largestOf(press.depths)));
  }
  return depth;
}

void ForceCharts::drawPresses()
{
  if (!waiting_)
  {
    return;
  }
  presses_ = *std::exchange(waiting_, std::nullopt);
  for (vtkPlot* plot : pressPlots_)
  {
    overDepth_->RemovePlotInstance(plot);
  }
  pressPlots_.clear();
  for (const PressCurve& press : presses_)
  {
    vtkNew<vtkTable> table;
    addColumns(*table, { "depth [mm]", "force [N]" });
    table->SetNumberOfRows(static_cast<vtkIdType>(press.depths.size()));
    for (std::size_t i = 0; i < press.depths.size(); ++i)
    {
      const auto row = static_cast<vtkIdType>(i);
      table->SetValue(row, 0, units::toMillimeters(press.depths[i]));
      table->SetValue(row, 1, press.forces[i]);
    }
    vtkPlot* plot = addLine(*overDepth_, press.name.c_str(), press.color, kPressWidth);
    plot->GetPen()->SetLineType(static_cast<int>(press.style));
    plot->SetInputData(table, 0, 1);
    pressPlots_.push_back(plot);
  }
}

void ForceCharts::clear()
{
  samples_->Clear();
  rendered_->Clear();
  update();
}

void ForceCharts::mark(const Sample* moment)
{
  marked_->SetNumberOfRows(moment != nullptr ? 1 : 0);
  if (moment != nullptr)
  {
    marked_->SetValue(0, 0, moment->time);
    marked_->SetValue(0, 1, units::toMillimeters(moment->contact.depth));
    marked_->SetValue(0, 2, moment->response.force);
  }
  for (vtkIdType column = 0; column < marked_->GetNumberOfColumns(); ++column)
  {
    marked_->GetColumn(column)->Modified();
  }
  marked_->Modified();
}

void ForceCharts::setLaw(const ForceLaw& law)
{
  law_ = law;
  // the other laws know of nothing but the depth
  lawPlot_->SetLabel(
    law.settings().mode == LawMode::Corrected ? "model, flat half-space" : "model");
  lawLimit_ = 0.0;
  refresh();
}

std::vector<std::unique_ptr<Plot>> ForceCharts::plots() const
{
  std::vector<std::unique_ptr<Plot>> plots;
  Plot& time = *plots.emplace_back(std::make_unique<Plot>(kOverTime, kTime, kForce));
  vtkTable& law = *samples_->GetOutput(0);
  vtkTable& sent = *rendered_->GetOutput(0);
  time.addLine("model", columnOf(law, 0), columnOf(law, 1), appearance::kLaw, 3.0F);
  if (isSent_)
  {
    time.addLine(kSent, columnOf(sent, 0), columnOf(sent, 1), appearance::kMeasured, 1.0F);
  }
  Plot& depth = *plots.emplace_back(std::make_unique<Plot>(kOverDepth, kDepth, kForce));
  vtkTable& measured = *samples_->GetOutput(1);
  depth.addLine(
    lawPlot_->GetLabel(), columnOf(*lawTable_, 0), columnOf(*lawTable_, 1), appearance::kLaw, 5.0F);
  depth.addPoints("recorded", columnOf(measured, 0), columnOf(measured, 1), appearance::kMeasured,
    Plot::Mark::Circle, 3.0F);
  for (std::size_t i = 0; i < presses_.size(); ++i)
  {
    vtkTable& table = *pressPlots_[i]->GetInput();
    depth.addLine(presses_[i].name, columnOf(table, 0), columnOf(table, 1), presses_[i].color,
      kPressWidth, presses_[i].style);
  }
  for (const auto& plot : plots)
  {
    plot->setNote("as drawn, of each short time the least and the largest force; the samples.csv "
                  "of an export has each millisecond");
  }
  time.chart().TakeViewOf(*overTime_);
  depth.chart().TakeViewOf(*overDepth_);
  return plots;
}

void ForceCharts::drawLaw(double depthLimit)
{
  lawLimit_ = depthLimit;
  for (vtkIdType i = 0; i < kLawPoints; ++i)
  {
    const double depth = depthLimit * static_cast<double>(i) / (kLawPoints - 1);
    lawTable_->SetValue(i, 0, units::toMillimeters(depth));
    lawTable_->SetValue(i, 1, law_({ .depth = depth }).force);
  }
  lawTable_->GetColumn(0)->Modified();
  lawTable_->GetColumn(1)->Modified();
  lawTable_->Modified();
}

} // namespace palp
