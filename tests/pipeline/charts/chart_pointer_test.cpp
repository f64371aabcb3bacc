#include "pipeline/charts/curve_reading.h"
#include "pipeline/charts/plot.h"
#include "tests/pipeline/picture.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <vector>
#include <vtkAxis.h>
#include <vtkContextInteractorStyle.h>
#include <vtkContextScene.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkNew.h>

namespace palp
{
namespace
{

constexpr appearance::Color kBlue{ 0.0, 0.0, 1.0 };
constexpr appearance::Color kRed{ 1.0, 0.0, 0.0 };

// y = 2 x and y = 20 - x, below a hand on a mouse
class ChartPointer : public ::testing::Test
{
protected:
  ChartPointer()
  {
    const std::vector<double> x{ 0.0, 5.0, 10.0 };
    plots_.push_back(std::make_unique<Plot>("", "time [s]", "force [N]"));
    plots_[0]->addLine("rising", x, std::vector{ 0.0, 10.0, 20.0 }, kBlue, 3.0F);
    plots_[0]->addLine("falling", x, std::vector{ 20.0, 15.0, 10.0 }, kRed, 3.0F);
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(480, 320);
    style_->SetScene(showPlots(*window_, plots_));
    mouse_->SetRenderWindow(window_);
    mouse_->SetInteractorStyle(style_);
    window_->Render();
    for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
    {
      before_[static_cast<std::size_t>(side)] = range(side);
    }
  }

  [[nodiscard]] vtkPalpChart& chart() const
  {
    return plots_[0]->chart();
  }

  [[nodiscard]] std::array<double, 2> range(int side) const
  {
    return { chart().GetAxis(side)->GetMinimum(), chart().GetAxis(side)->GetMaximum() };
  }

  void expectAsAtFirst(int side) const
  {
    EXPECT_EQ(range(side), before_[static_cast<std::size_t>(side)]) << side;
  }

  // of an axis at a pixel, by proportion
  [[nodiscard]] double value(int side, int pixel) const
  {
    const int i = side == vtkAxis::BOTTOM ? 0 : 1;
    const double first = chart().GetPoint1()[i];
    const double share = (pixel - first) / (chart().GetPoint2()[i] - first);
    return range(side)[0] + share * (range(side)[1] - range(side)[0]);
  }

  void at(int x, int y, unsigned long event)
  {
    mouse_->SetEventInformation(x, y);
    mouse_->InvokeEvent(event);
  }

  void drag(std::array<int, 2> from, std::array<int, 2> to, unsigned long down, unsigned long up)
  {
    at(from[0], from[1], vtkCommand::MouseMoveEvent);
    at(from[0], from[1], down);
    at((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, vtkCommand::MouseMoveEvent);
    at(to[0], to[1], vtkCommand::MouseMoveEvent);
    at(to[0], to[1], up);
  }

  // within a rectangle of the picture
  [[nodiscard]] int pixelsOf(const appearance::Color& color, std::array<int, 4> within)
  {
    const auto image = test::imageOf(*window_);
    int count = 0;
    for (int y = within[1]; y < within[3]; ++y)
    {
      for (int x = within[0]; x < within[2]; ++x)
      {
        bool isAlike = true;
        for (int k = 0; k < 3; ++k)
        {
          const double part = image->GetScalarComponentAsDouble(x, y, 0, k) / 255.0;
          isAlike = isAlike && std::abs(part - color[static_cast<std::size_t>(k)]) < 0.2;
        }
        count += isAlike ? 1 : 0;
      }
    }
    return count;
  }

  [[nodiscard]] std::array<int, 4> inside() const
  {
    return { chart().GetPoint1()[0], chart().GetPoint1()[1], chart().GetPoint2()[0],
      chart().GetPoint2()[1] };
  }

  std::vector<std::unique_ptr<Plot>> plots_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkContextInteractorStyle> style_;
  vtkNew<vtkGenericRenderWindowInteractor> mouse_;
  std::array<std::array<double, 2>, 2> before_{};
};

TEST_F(ChartPointer, WheelZoomsAboutWhatIsBelowIt)
{
  const double x = value(vtkAxis::BOTTOM, 300);
  const double y = value(vtkAxis::LEFT, 200);
  const double across = range(vtkAxis::BOTTOM)[1] - range(vtkAxis::BOTTOM)[0];
  at(300, 200, vtkCommand::MouseWheelForwardEvent);
  at(300, 200, vtkCommand::MouseWheelForwardEvent);
  EXPECT_NEAR(value(vtkAxis::BOTTOM, 300), x, 1e-9);
  EXPECT_NEAR(value(vtkAxis::LEFT, 200), y, 1e-9);
  EXPECT_NEAR(range(vtkAxis::BOTTOM)[1] - range(vtkAxis::BOTTOM)[0], 0.64 * across, 1e-9);
  at(300, 200, vtkCommand::MouseWheelBackwardEvent);
  at(300, 200, vtkCommand::MouseWheelBackwardEvent);
  EXPECT_NEAR(range(vtkAxis::BOTTOM)[1] - range(vtkAxis::BOTTOM)[0], across, 1e-9);
}

TEST_F(ChartPointer, WheelBesideAnAxisZoomsThatAxisAlone)
{
  at(300, chart().GetPoint1()[1] - 10, vtkCommand::MouseWheelForwardEvent);
  EXPECT_TRUE(chart().IsHeld(vtkAxis::BOTTOM));
  EXPECT_FALSE(chart().IsHeld(vtkAxis::LEFT));
  expectAsAtFirst(vtkAxis::LEFT);
}

TEST_F(ChartPointer, ADragTakesTheCurvesAlong)
{
  const double x = value(vtkAxis::BOTTOM, 200);
  const double y = value(vtkAxis::LEFT, 150);
  drag({ 200, 150 }, { 260, 180 }, vtkCommand::LeftButtonPressEvent,
    vtkCommand::LeftButtonReleaseEvent);
  EXPECT_NEAR(value(vtkAxis::BOTTOM, 260), x, 1e-9);
  EXPECT_NEAR(value(vtkAxis::LEFT, 180), y, 1e-9);
}

TEST_F(ChartPointer, ARightDragZoomsIntoItsRectangle)
{
  const double left = value(vtkAxis::BOTTOM, 150);
  const double right = value(vtkAxis::BOTTOM, 250);
  const double low = value(vtkAxis::LEFT, 120);
  const double high = value(vtkAxis::LEFT, 220);
  drag({ 250, 120 }, { 150, 220 }, vtkCommand::RightButtonPressEvent,
    vtkCommand::RightButtonReleaseEvent);
  EXPECT_NEAR(range(vtkAxis::BOTTOM)[0], left, 1e-9);
  EXPECT_NEAR(range(vtkAxis::BOTTOM)[1], right, 1e-9);
  EXPECT_NEAR(range(vtkAxis::LEFT)[0], low, 1e-9);
  EXPECT_NEAR(range(vtkAxis::LEFT)[1], high, 1e-9);
}

TEST_F(ChartPointer, ADoubleClickFollowsTheDataAgain)
{
  at(300, 200, vtkCommand::MouseWheelForwardEvent);
  at(300, 200, vtkCommand::LeftButtonDoubleClickEvent);
  window_->Render();
  expectAsAtFirst(vtkAxis::BOTTOM);
  expectAsAtFirst(vtkAxis::LEFT);
}

TEST_F(ChartPointer, AnAxisThatIsHeldDoesNotFollowTheData)
{
  chart().SetFollowed(vtkAxis::LEFT, 0.0, 20.0);
  chart().Hold(vtkAxis::LEFT, 5.0, 6.0);
  chart().SetFollowed(vtkAxis::LEFT, 0.0, 90.0);
  EXPECT_EQ(range(vtkAxis::LEFT), (std::array{ 5.0, 6.0 }));
  chart().Hold(vtkAxis::LEFT, 6.0, 5.0); // no range
  EXPECT_EQ(range(vtkAxis::LEFT), (std::array{ 5.0, 6.0 }));
  chart().FollowData();
  EXPECT_EQ(range(vtkAxis::LEFT), (std::array{ 0.0, 90.0 }));
}

// its name stays, to show it again
TEST_F(ChartPointer, AClickAtANameHidesItsCurve)
{
  ASSERT_GT(pixelsOf(kBlue, inside()), 200);
  const int atName = 20;
  const int red = pixelsOf(kRed, inside());
  for (const bool isHidden : { true, false })
  {
    const int y = (chart().GetPoint1()[1] > 0 ? 12 : 0);
    drag({ atName, y }, { atName, y }, vtkCommand::LeftButtonPressEvent,
      vtkCommand::LeftButtonReleaseEvent);
    EXPECT_EQ(chart().IsCurveShown("rising"), !isHidden);
    EXPECT_EQ(pixelsOf(kBlue, inside()) == 0, isHidden);
    EXPECT_GT(pixelsOf(kRed, inside()), red / 2);
  }
}

TEST_F(ChartPointer, AxesShrinkToTheCurvesThatAreShown)
{
  const std::vector<double> x{ 0.0, 10.0 };
  plots_[0]->addLine("spike", x, std::vector{ 0.0, 500.0 }, kRed);
  chart().RecalculateBounds();
  window_->Render();
  EXPECT_GE(range(vtkAxis::LEFT)[1], 500.0);
  chart().SetCurveShown("spike", false);
  window_->Render();
  EXPECT_LT(range(vtkAxis::LEFT)[1], 40.0);
}

TEST_F(ChartPointer, ReadsTheValuesBelowIt)
{
  const int x = 240;
  const double time = value(vtkAxis::BOTTOM, x);
  const auto readings = chart().ReadingsAt(time, 0.0);
  ASSERT_EQ(readings.size(), 2U);
  EXPECT_EQ(readings[0].Name, "rising");
  EXPECT_NEAR(readings[0].Value, 2.0 * time, 1e-9);
  EXPECT_NEAR(readings[1].Value, 20.0 - time, 1e-9);
  EXPECT_TRUE(chart().ReadingOf(vtkAxis::LEFT, 3.14159).ends_with(" N"));

  // a line from below to above, and a dot on each curve
  const auto plain = test::imageOf(*window_);
  at(x, 200, vtkCommand::MouseMoveEvent);
  EXPECT_TRUE(style_->GetScene()->GetDirty());
  const auto read = test::imageOf(*window_);
  const auto isChanged = [&](int column, int row)
  {
    return std::abs(read->GetScalarComponentAsDouble(column, row, 0, 1) -
             plain->GetScalarComponentAsDouble(column, row, 0, 1)) > 30.0;
  };
  int line = 0; // its pixel may be that at either side of its place
  for (int y = inside()[1]; y < inside()[3]; ++y)
  {
    line += isChanged(x - 1, y) || isChanged(x, y) ? 1 : 0;
  }
  EXPECT_GT(line, 0.8 * (inside()[3] - inside()[1]));
  const double share =
    (2.0 * time - range(vtkAxis::LEFT)[0]) / (range(vtkAxis::LEFT)[1] - range(vtkAxis::LEFT)[0]);
  const int y = static_cast<int>(std::lround(std::lerp(inside()[1], inside()[3], share)));
  int dot = 0; // beside the line
  for (int i = -5; i <= 5; ++i)
  {
    dot += isChanged(x - 3, y + i) || isChanged(x + 3, y + i) ? 1 : 0;
  }
  EXPECT_GT(dot, 2);
  EXPECT_LT(test::differenceFromBaseline(*read, "chart_readings").changed, 0.01);

  at(x, 2, vtkCommand::MouseMoveEvent); // at the legend
  EXPECT_EQ(test::differenceOf(*test::imageOf(*window_), *plain).mean, 0.0);
}

// the outline of a tool stands several times above one place
// of curves that a zoom has left above and below
TEST_F(ChartPointer, DrawsNoDotBesideTheCurves)
{
  chart().Hold(vtkAxis::LEFT, 12.0, 13.0);
  const auto plain = test::imageOf(*window_);
  at(inside()[0] + 30, 200, vtkCommand::MouseMoveEvent);
  const auto read = test::imageOf(*window_);
  int outside = 0;
  int within = 0;
  for (int x = 0; x < 480; ++x)
  {
    for (int y = 0; y < 320; ++y)
    {
      const bool isChanged = std::abs(read->GetScalarComponentAsDouble(x, y, 0, 1) -
                               plain->GetScalarComponentAsDouble(x, y, 0, 1)) > 30.0;
      const bool isIn = y >= inside()[1] - 2 && y <= inside()[3] + 2;
      (isIn ? within : outside) += isChanged ? 1 : 0;
    }
  }
  EXPECT_GT(within, 100) << "the line";
  EXPECT_EQ(outside, 0);
}

// at the line, not below the pointer: what is recorded is read there as the curves beside it are
TEST_F(ChartPointer, ReadsThePointAtTheLine)
{
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i <= 500; ++i)
  {
    x.push_back(0.02 * i);
    y.push_back(0.04 * i);
  }
  plots_[0]->addPoints("recorded", x, y, kRed);
  (void)test::imageOf(*window_);
  for (const double pointer : { 2.0, 9.0, 19.0 })
  {
    const auto readings = chart().ReadingsAt(5.0, pointer);
    ASSERT_EQ(readings.size(), 3U);
    EXPECT_EQ(readings[2].Name, "recorded");
    EXPECT_NEAR(readings[2].Value, 10.0, 0.1) << pointer; // a pixel is 0.05
  }
}

TEST(CurveReading, TakesTheNearestOfSeveralValues)
{
  const std::vector<double> x{ -1.0, 1.0, 1.0, -1.0 };
  const std::vector<double> y{ 0.0, 2.0, 6.0, 8.0 };
  EXPECT_NEAR(valueOfLine(x, y, 0.0, 0.0).value(), 1.0, 1e-12);
  EXPECT_NEAR(valueOfLine(x, y, 0.0, 9.0).value(), 7.0, 1e-12);
  EXPECT_NEAR(valueOfLine(x, y, 1.0, 4.5).value(), 4.5, 1e-12);
  EXPECT_FALSE(valueOfLine(x, y, 1.5, 0.0).has_value());
}

TEST(CurveReading, IsAsExactAsAPixel)
{
  EXPECT_EQ(readingText(3.14159, 0.02), "3.14");
  EXPECT_EQ(readingText(3.14159, 0.2), "3.1");
  EXPECT_EQ(readingText(314.159, 5.0), "314");
  EXPECT_EQ(unitOf("depth \u03b4 [mm]"), "mm");
  EXPECT_EQ(unitOf("count"), "");
}

} // namespace
} // namespace palp
