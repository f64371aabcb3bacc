#include "pipeline/charts/force_charts.h"

#include "haptics/units.h"
#include "pipeline/charts/vtkPalpChart.h"
#include "pipeline/view/appearance.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <tuple>
#include <utility>
#include <vector>
#include <vtkAxis.h>
#include <vtkContextView.h>
#include <vtkNew.h>
#include <vtkPlot.h>
#include <vtkRenderWindow.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVariant.h>

namespace palp
{
namespace
{

using namespace units::literals;

class Charts : public ::testing::Test
{
protected:
  Charts()
  {
    view_->GetRenderWindow()->SetOffScreenRendering(1);
    view_->GetRenderWindow()->SetSize(320, 200);
    charts_.addForceOverTime(*view_->GetScene());
    charts_.addForceOverDepth(*depthView_->GetScene());
  }

  // a second of a steady force
  void add(double force, double depth)
  {
    for (int i = 0; i < 100; ++i, time_ += 0.01)
    {
      Sample sample;
      sample.time = time_;
      sample.contact.depth = depth + 1e-6 * (i % 50);
      sample.response.force = force;
      sample.force = force * Eigen::Vector3d::UnitZ();
      charts_.add(sample);
    }
    charts_.refresh();
  }

  [[nodiscard]] static double top(vtkContextView& view, int side)
  {
    return vtkChartXY::SafeDownCast(view.GetScene()->GetItem(0))->GetAxis(side)->GetMaximum();
  }

  ForceCharts charts_;
  vtkNew<vtkContextView> view_;
  vtkNew<vtkContextView> depthView_;
  double time_ = 0.0;
};

TEST_F(Charts, ShrinkOnceASpikeIsNoLongerSeen)
{
  add(42.0, 38.0_mm);
  EXPECT_GE(top(*view_, vtkAxis::LEFT), 42.0);
  EXPECT_GE(top(*depthView_, vtkAxis::BOTTOM), 38.0);
  for (int second = 0; second < 70; ++second)
  {
    add(2.0, 4.0_mm);
  }
  EXPECT_GE(top(*view_, vtkAxis::LEFT), 2.0);
  EXPECT_LE(top(*view_, vtkAxis::LEFT), 4.0);
  EXPECT_GE(top(*depthView_, vtkAxis::BOTTOM), 4.0);
  EXPECT_LE(top(*depthView_, vtkAxis::BOTTOM), 8.0);
}

// of WCAG 2.1: luminances of sRGB
double contrastOf(const appearance::Color& a, const appearance::Color& b)
{
  const auto luminance = [](const appearance::Color& color)
  {
    const auto linear = [](double c)
    { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
  };
  const auto [low, high] = std::minmax({ luminance(a), luminance(b) });
  return (high + 0.05) / (low + 0.05);
}

TEST_F(Charts, ShowEachLiveCurveClearlyOnLightAndOnDark)
{
  constexpr double kOfGraphics = 3.0; // WCAG 2.1, 1.4.11
  constexpr appearance::Color kDark{ 0.13, 0.14, 0.16 };
  for (vtkContextView* view : { view_.Get(), depthView_.Get() })
  {
    auto& chart = *vtkChartXY::SafeDownCast(view->GetScene()->GetItem(0));
    for (vtkIdType i = 0; i < chart.GetNumberOfPlots(); ++i)
    {
      vtkPlot& plot = *chart.GetPlot(i);
      appearance::Color color{};
      plot.GetColor(color.data());
      const bool isCurve = !plot.GetLabel().empty(); // others are in ink
      EXPECT_TRUE(!isCurve || contrastOf(color, appearance::kPaper) >= kOfGraphics)
        << plot.GetLabel();
      EXPECT_TRUE(!isCurve || contrastOf(color, kDark) >= kOfGraphics) << plot.GetLabel();
    }
  }
}

TEST_F(Charts, StayWhileTheyArePausedAndForgetWhatIsCleared)
{
  add(2.0, 4.0_mm);
  charts_.setPaused(true);
  add(30.0, 14.0_mm);
  EXPECT_LE(top(*view_, vtkAxis::LEFT), 4.0);
  EXPECT_LE(top(*depthView_, vtkAxis::BOTTOM), 8.0);
  charts_.setPaused(false);
  charts_.refresh();
  EXPECT_GE(top(*view_, vtkAxis::LEFT), 30.0);
  charts_.setPaused(true);
  charts_.clear();
  EXPECT_LE(top(*view_, vtkAxis::LEFT), 4.0);
  EXPECT_EQ(charts_.plots()[0]->tables()[0]->GetNumberOfRows(), 0);
}

// dark pixels of one place more, in the middle of the curve's force
TEST_F(Charts, MarkAMoment)
{
  const auto ink = [](vtkContextView& view)
  {
    std::vector<std::pair<int, int>> dark;
    view.GetRenderWindow()->SetOffScreenRendering(1);
    view.GetRenderWindow()->SetSize(320, 200);
    view.Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    view.GetRenderWindow()->GetPixelData(0, 0, 319, 199, 0, pixels);
    for (int i = 0; i < 320 * 200; ++i)
    {
      if (pixels->GetTypedComponent(i, 0) < 90 && pixels->GetTypedComponent(i, 2) < 90)
      {
        dark.emplace_back(i % 320, i / 320);
      }
    }
    return dark;
  };
  add(2.0, 4.0_mm);
  Sample moment;
  moment.time = 0.5;
  moment.contact.depth = 4.0_mm;
  moment.response.force = 1.0;
  for (vtkContextView* view : { view_.Get(), depthView_.Get() })
  {
    const auto before = ink(*view);
    charts_.mark(&moment);
    auto marked = ink(*view);
    std::erase_if(marked, [&](const auto& at) { return std::ranges::count(before, at) > 0; });
    ASSERT_GT(marked.size(), 9U);
    auto* chart = vtkChartXY::SafeDownCast(view->GetScene()->GetItem(0));
    const double left = chart->GetPoint1()[0];
    const double right = chart->GetPoint2()[0];
    const double value = view == view_.Get() ? moment.time : 4.0;
    const double x = left + (right - left) * value / chart->GetAxis(vtkAxis::BOTTOM)->GetMaximum();
    for (const auto& [column, row] : marked)
    {
      EXPECT_NEAR(column, x, 7.0);
    }
    charts_.mark(nullptr);
    EXPECT_EQ(ink(*view), before);
  }
}

// a spike of one sample among a minute of them, at the time of that sample
TEST_F(Charts, ShowMoreOfLessTime)
{
  constexpr int kSpike = 31'417; // [ms]
  for (int i = 0; i < 60'000; ++i)
  {
    Sample sample;
    sample.time = 0.001 * i;
    sample.response.force = i == kSpike ? 7.0 : 1.0;
    charts_.add(sample);
  }
  const auto spikeTimes = [this]
  {
    std::vector<double> times;
    const auto plots = charts_.plots();
    vtkTable& table = *plots[0]->tables()[0];
    for (vtkIdType row = 0; row < table.GetNumberOfRows(); ++row)
    {
      if (table.GetValue(row, 1).ToDouble() > 6.9)
      {
        times.push_back(table.GetValue(row, 0).ToDouble());
      }
    }
    return times;
  };
  charts_.refresh();
  ASSERT_EQ(spikeTimes().size(), 1U);
  EXPECT_NEAR(spikeTimes()[0], 0.001 * kSpike, 0.080); // a minute over 800 columns
  vtkPalpChart::SafeDownCast(view_->GetScene()->GetItem(0))->Hold(vtkAxis::BOTTOM, 31.0, 32.0);
  charts_.refresh();
  ASSERT_EQ(spikeTimes().size(), 1U);
  EXPECT_NEAR(spikeTimes()[0], 0.001 * kSpike, 0.005);
}

// the legend stands below, the curves above
TEST_F(Charts, KeepTheLegendOffTheCurves)
{
  add(2.0, 4.0_mm);
  view_->GetRenderWindow()->Render();
  auto* chart = vtkPalpChart::SafeDownCast(view_->GetScene()->GetItem(0));
  const float legend = chart->GetSize().GetY();
  EXPECT_GT(legend, 10.0F);
  EXPECT_GT(static_cast<float>(chart->GetPoint1()[1]), legend);
  EXPECT_LE(chart->GetPoint2()[1], 200);
  EXPECT_GT(chart->GetPoint2()[1] - chart->GetPoint1()[1], 80) << "room for the curves";
}

TEST_F(Charts, CanBeLaidOutAnewWithAllTheirCurves)
{
  add(2.0, 4.0_mm);
  const auto plots = charts_.plots();
  ASSERT_EQ(plots.size(), 2U);
  EXPECT_EQ(plots[0]->tables().size(), 1U) << "no device is sent a force";
  vtkTable& time = *plots[0]->tables()[0];
  EXPECT_NEAR(time.GetValue(time.GetNumberOfRows() - 1, 1).ToDouble(), 2.0, 1e-6);
  vtkTable& measured = *plots[1]->tables()[1];
  EXPECT_NEAR(measured.GetValue(0, 0).ToDouble(), 4.0, 1e-5);
}

// 0.1 as it was recorded, not as the nearest float goes on
TEST_F(Charts, GiveTheNumbersOfTheFloatsThatTheyKeep)
{
  add(0.1, 1.7_mm);
  const auto plots = charts_.plots();
  std::set<double> forces;
  std::set<double> depths;
  for (const auto& [values, table, column] : { std::tuple(&forces, plots[0]->tables()[0], 1),
         std::tuple(&depths, plots[1]->tables()[1], 0) })
  {
    for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
    {
      values->insert(table->GetValue(row, column).ToDouble());
    }
  }
  EXPECT_EQ(forces.count(0.1), 1U);
  EXPECT_EQ(forces.count(static_cast<double>(0.1F)), 0U);
  EXPECT_EQ(depths.count(1.7), 1U);
}

TEST_F(Charts, DrawWhatIsSentBesideTheModelWhereADeviceIsSentIt)
{
  charts_.setSent(true);
  add(2.0, 4.0_mm);
  const auto plots = charts_.plots();
  ASSERT_EQ(plots[0]->tables().size(), 2U);
  EXPECT_NEAR(plots[0]->tables()[1]->GetValue(50, 1).ToDouble(), 2.0, 1e-6);
}

// [columns] where the left part of a picture is rather of one color than of another, least and most
std::pair<int, int> columnsOf(vtkRenderWindow& window, int width, int color, int other)
{
  vtkNew<vtkUnsignedCharArray> pixels;
  window.GetPixelData(0, 0, width - 1, window.GetSize()[1] - 1, 0, pixels);
  std::pair<int, int> columns{ width, -1 };
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    if (pixels->GetComponent(i, color) > pixels->GetComponent(i, other) + 60)
    {
      const int column = static_cast<int>(i % width);
      columns = { std::min(columns.first, column), std::max(columns.second, column) };
    }
  }
  return columns;
}

TEST_F(Charts, KeepTheirTitlesOffTheNumbersAtEachScale)
{
  vtkAxis& axis = *vtkChartXY::SafeDownCast(view_->GetScene()->GetItem(0))->GetAxis(vtkAxis::LEFT);
  axis.GetTitleProperties()->SetColor(1.0, 0.0, 0.0);
  axis.GetLabelProperties()->SetColor(0.0, 1.0, 0.0);
  for (const int scale : { 1, 2, 3 })
  {
    view_->GetRenderWindow()->SetDPI(72 * scale);
    view_->GetRenderWindow()->SetSize(320 * scale, 200 * scale);
    for (const double force : { 0.01, 2.0, 1234.0 })
    {
      charts_.clear();
      add(force, 4.0_mm);
      view_->GetRenderWindow()->Render();
      const int left = static_cast<int>(axis.GetPoint1()[0]) - 2 * scale; // of the curves
      const auto title = columnsOf(*view_->GetRenderWindow(), left, 0, 1);
      const auto numbers = columnsOf(*view_->GetRenderWindow(), left, 1, 0);
      ASSERT_GT(title.second, title.first);
      ASSERT_GT(numbers.second, numbers.first);
      EXPECT_GT(title.first, 0) << "cut at scale " << scale << ", " << force << " N";
      EXPECT_GT(numbers.first, title.second) << "at scale " << scale << ", " << force << " N";
    }
  }
}

TEST_F(Charts, KeepTheirTitlesApartWhereNoCurveIsSeen)
{
  auto& chart = *vtkPalpChart::SafeDownCast(view_->GetScene()->GetItem(0));
  for (vtkIdType i = 0; i < chart.GetNumberOfPlots(); ++i)
  {
    chart.SetCurveShown(chart.GetPlot(i)->GetLabel(), false);
  }
  chart.SetKeyed(false); // whose letters have the color of a title
  chart.GetAxis(vtkAxis::LEFT)->GetTitleProperties()->SetColor(1.0, 0.0, 0.0);
  chart.GetAxis(vtkAxis::BOTTOM)->GetTitleProperties()->SetColor(0.0, 1.0, 0.0);
  view_->GetRenderWindow()->Render();
  const auto force = columnsOf(*view_->GetRenderWindow(), 320, 0, 1);
  const auto time = columnsOf(*view_->GetRenderWindow(), 320, 1, 0);
  ASSERT_GT(force.second, force.first);
  EXPECT_GT(time.first, force.second + 40) << "in the middle of its axis";
}

} // namespace
} // namespace palp
