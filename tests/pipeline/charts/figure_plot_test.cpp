#include "pipeline/charts/figure_plot.h"

#include "haptics/error.h"

#include <gtest/gtest.h>
#include <vtkPlotLine.h>
#include <vtkVariant.h>

namespace palp
{
namespace
{

using namespace figures;

class FigurePlot : public ::testing::Test
{
protected:
  FigurePlot()
  {
    addCurve(
      figure, points, { .label = "law", .color = 1 }, { { 0.0, 2.0, 3.0 }, { 1.0, 4.0, 9.0 } });
    addCurve(figure, points, { .label = "elements", .style = Curve::Style::Circles, .color = 2 },
      { { 2.0 }, { 5.0 } });
  }

  [[nodiscard]] std::unique_ptr<Plot> plot(Layout layout) const
  {
    return figurePlot(figure, std::span(&points, 1), layout);
  }

  Figure figure{ .name = "f", .caption = "F", .bottom = "x [mm]", .left = "y [%]" };
  Table points = pointTable(figure);
};

TEST_F(FigurePlot, HasEveryCurveInItsUnits)
{
  for (const Layout layout : { Layout::Alone, Layout::OnPage })
  {
    const auto drawn = plot(layout);
    ASSERT_EQ(drawn->tables().size(), 2U);
    vtkTable& line = *drawn->tables()[0];
    EXPECT_EQ(line.GetNumberOfRows(), 3);
    EXPECT_STREQ(line.GetColumnName(0), "x [mm]");
    EXPECT_STREQ(line.GetColumnName(1), "law");
    EXPECT_EQ(line.GetValue(2, 1).ToDouble(), 9.0);
    EXPECT_EQ(drawn->tables()[1]->GetValue(0, 0).ToDouble(), 2.0);
  }
}

TEST_F(FigurePlot, LaysItsBandUnderTheFirstCurve)
{
  figure.band = 7.0;
  const auto drawn = plot(Layout::Alone);
  ASSERT_EQ(drawn->tables().size(), 3U);
  vtkTable& band = *drawn->tables()[0];
  ASSERT_EQ(band.GetNumberOfRows(), 3);
  EXPECT_EQ(band.GetValue(2, 0).ToDouble(), 3.0);
  EXPECT_EQ(band.GetValue(2, 1).ToDouble(), -7.0);
  EXPECT_EQ(band.GetValue(2, 2).ToDouble(), 7.0);
}

TEST_F(FigurePlot, ShowsALineOfOnePointAsAMarkAndRefusesAMissingTable)
{
  figure.curves[1].style = Curve::Style::Line;
  const auto drawn = plot(Layout::OnPage);
  ASSERT_EQ(drawn->tables().size(), 2U);
  EXPECT_EQ(vtkPlotLine::SafeDownCast(drawn->chart().GetPlot(1)), nullptr);
  figure.curves[1].table = "elsewhere";
  EXPECT_THROW(plot(Layout::OnPage), Error);
}

} // namespace
} // namespace palp
