#include "app/plots/chart_job.h"

#include "haptics/error.h"
#include "tests/pipeline/picture.h"

#include <gtest/gtest.h>
#include <vector>
#include <vtkAxis.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkRendererCollection.h>
#include <vtkStringArray.h>

namespace palp
{
namespace
{

// one of each kind of curve, one hidden, and an axis that is held
Plots everyKind()
{
  const std::vector<double> x{ 0.0, 1.0, 2.0, 4.0 };
  const std::vector<double> y{ 0.0, 1.0, 4.0, 16.0 };
  const std::vector<double> more{ 2.0, 3.0, 6.0, 18.0 };
  Plots plots;
  Plot& first = *plots.emplace_back(std::make_unique<Plot>("first", "x [mm]", "y [N]"));
  first.addBand("band", x, y, more, { 0.9, 0.5, 0.1 });
  first.addLine("dashed", x, y, { 0.1, 0.2, 0.8 }, 3.0F, appearance::LineStyle::Dashed);
  first.addLine("", x, more, { 0.1, 0.2, 0.8 });
  first.addPoints("squares", x, more, { 0.0, 0.6, 0.2 }, Plot::Mark::Square, 9.0F);
  first.chart().Hold(vtkAxis::BOTTOM, 0.5, 3.5);
  Plot& second = *plots.emplace_back(std::make_unique<Plot>("second", "t [s]", "y [N]"));
  second.addLine("seen", x, y, { 0.8, 0.0, 0.0 });
  second.addLine("hidden", x, more, { 0.0, 0.8, 0.0 });
  second.chart().SetCurveShown("hidden", false);
  return plots;
}

vtkSmartPointer<vtkImageData> drawn(const Plots& plots)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(800, 750);
  showPlots(*window, plots);
  auto picture = test::imageOf(*window);
  window->GetRenderers()->RemoveAllItems(); // the charts outlive it
  return picture;
}

TEST(ChartJob, ComesOutAsItWentIn)
{
  const Plots plots = everyKind();
  const auto job = unpackChartJob(pack(ChartSheet::of(plots, "a.pdf", ImageSize{}), plots));
  ASSERT_TRUE(job);
  EXPECT_EQ(job->sheet.ending, ".pdf");
  const auto picture = drawn(plots);
  EXPECT_EQ(test::differenceOf(*drawn(job->plots), *picture).mean, 0.0);
  Plots other = everyKind();
  other[1]->chart().SetCurveShown("hidden", true);
  EXPECT_GT(test::differenceOf(*drawn(other), *picture).mean, 0.0) << "what is hidden is seen";
}

TEST(ChartJob, OfAnotherBuildIsRefused)
{
  const std::string whole = pack(ChartSheet{}, everyKind());
  EXPECT_TRUE(unpackChartJob(whole));
  EXPECT_FALSE(unpackChartJob(whole + '!'));
  for (std::size_t size = 0; size < whole.size(); size += 7)
  {
    EXPECT_FALSE(unpackChartJob(std::string_view(whole).substr(0, size))) << size;
  }
}

// a picture four times as large has letters twice as large, lines and text keep their size
TEST(ChartSheet, GrowsItsLettersWithTheSize)
{
  const Plots plots = everyKind();
  const ImageSize usual = ChartSheet::usualSize(plots);
  const ImageSize large{ .width = 2 * usual.width, .height = 2 * usual.height };
  const ChartSheet picture = ChartSheet::of(plots, "a.png", {});
  const ChartSheet larger = ChartSheet::of(plots, "a.png", large);
  EXPECT_EQ(larger.size.width, large.width);
  EXPECT_EQ(larger.dpi, 2 * picture.dpi);
  const ChartSheet lines = ChartSheet::of(plots, "a.svg", {});
  EXPECT_EQ(2 * lines.size.width, usual.width);
  EXPECT_EQ(2 * lines.dpi, picture.dpi);
  EXPECT_THROW((void)ChartSheet::of(plots, "a.bmp", {}), Error);
  for (const char* file : { "a.png", "a.svg" })
  {
    EXPECT_NO_THROW((void)ChartSheet::of(plots, file, ImageSize{ 200, 375 }));
    EXPECT_THROW((void)ChartSheet::of(plots, file, ImageSize{ 200, 374 }), Error) << "two charts";
    EXPECT_THROW((void)ChartSheet::of(plots, file, ImageSize{ 199, 1000 }), Error);
  }
}

// each has a width of its own, of letters about 0.6 as wide as high
TEST(ChartSheet, NumbersOfAnAxisStandApartAtAnySize)
{
  for (const ImageSize size : { ImageSize{ 400, 300 }, { 1600, 1000 }, { 3840, 2160 } })
  {
    for (const double range : { 0.0007, 0.02, 7.3, 12'000.0 })
    {
      Plots plots;
      Plot& plot = *plots.emplace_back(std::make_unique<Plot>("", "depth [mm]", "force [N]"));
      const std::vector<double> x{ 0.0, 0.5 * range, range };
      plot.addLine("one", x, std::vector<double>{ 0.0, 0.3 * range, range }, { 0.0, 0.0, 0.8 });
      const ChartSheet sheet = ChartSheet::of(plots, "a.png", size);
      vtkNew<vtkRenderWindow> window;
      window->SetOffScreenRendering(1);
      window->SetSize(sheet.size.width, sheet.size.height);
      window->SetDPI(sheet.dpi);
      showPlots(*window, plots);
      window->Render();
      plot.chart().SpaceTicks();
      window->Render();
      const double letter = 12.0 * sheet.dpi / 72.0;
      for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
      {
        vtkAxis& axis = *plot.chart().GetAxis(side);
        vtkDoubleArray& ticks = *axis.GetTickPositions();
        vtkStringArray& labels = *axis.GetTickLabels();
        ASSERT_GE(ticks.GetNumberOfValues(), 2) << range;
        const double length = side == vtkAxis::LEFT ? axis.GetPoint2()[1] - axis.GetPoint1()[1]
                                                    : axis.GetPoint2()[0] - axis.GetPoint1()[0];
        const double apart = length * (ticks.GetValue(1) - ticks.GetValue(0)) /
          (axis.GetMaximum() - axis.GetMinimum());
        std::size_t longest = 0;
        for (vtkIdType i = 0; i < labels.GetNumberOfValues(); ++i)
        {
          longest = std::max(longest, labels.GetValue(i).size());
          EXPECT_NE(labels.GetValue(i), "-0");
          EXPECT_NEAR(std::stod(labels.GetValue(i)), ticks.GetValue(i), 1e-3 * range);
        }
        const double needed = side == vtkAxis::LEFT ? 1.2 : 0.6 * static_cast<double>(longest);
        EXPECT_GT(apart, needed * letter) << size.width << ", " << range << ", side " << side;
      }
      window->GetRenderers()->RemoveAllItems(); // the charts outlive it
    }
  }
}

} // namespace
} // namespace palp
