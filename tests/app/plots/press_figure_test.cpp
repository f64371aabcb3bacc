#include "app/plots/press_figure.h"

#include "haptics/units.h"
#include "pipeline/figure/ambient_occlusion.h"
#include "tests/app/plots/figure_rig.h"

#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderPass.h>
#include <vtkRenderWindow.h>
#include <vtkSphereSource.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::PressFigure;

// share of the picture where a channel is stronger than the two others
double shareOf(int channel, vtkImageData& image)
{
  constexpr double kMore = 20.0;
  int count = 0;
  for (int y = 0; y < 360; ++y)
  {
    for (int x = 0; x < 480; ++x)
    {
      const auto value = [&](int k) { return image.GetScalarComponentAsDouble(x, y, 0, k % 3); };
      count +=
        value(channel) > value(channel + 1) + kMore && value(channel) > value(channel + 2) + kMore;
    }
  }
  return count / (480.0 * 360.0);
}

TEST_F(PressFigure, ShowsOrgansInTheirColorsAndWhatIsBehindThoseThatAreSeenThrough)
{
  EXPECT_GT(shareOf(0, *figure({})), 0.1) << "red, as the liver";
  moment_.color = { 0.1, 0.6, 0.1 };
  const double alone = shareOf(1, *figure({}));
  EXPECT_GT(alone, 0.1) << "green";
  vtkNew<vtkSphereSource> around;
  around->SetRadius(ball_.surface->GetLength());
  around->Update();
  moment_.around = {
    { .surface = around->GetOutput(), .color = { 0.1, 0.1, 0.9 }, .isClosed = true }
  };
  const auto opaque = figure({});
  EXPECT_EQ(shareOf(1, *opaque), 0.0);
  EXPECT_GT(shareOf(2, *opaque), 0.15) << "all of it is seen";
  moment_.around.front().isTranslucent = true;
  EXPECT_GT(shareOf(1, *figure({})), 0.002);
}

// laid over the background of the opaque one it is that one, at the edges and under the tool, too
TEST_F(PressFigure, WithoutABackgroundIsTheSameOverAnyOther)
{
  const auto opaque = figure({ .overlays = { Overlay::DisplacementColors } });
  const auto clear = figure({ .isTransparent = true, .overlays = { Overlay::DisplacementColors } });
  ASSERT_EQ(opaque->GetNumberOfScalarComponents(), 3);
  ASSERT_EQ(clear->GetNumberOfScalarComponents(), 4);
  EXPECT_EQ(clear->GetScalarComponentAsDouble(0, 0, 0, 3), 0.0);
  double sum = 0.0;
  int partly = 0;
  for (int y = 0; y < 360; ++y)
  {
    for (int x = 0; x < 480; ++x)
    {
      const double share = clear->GetScalarComponentAsDouble(x, y, 0, 3) / 255.0;
      partly += share > 0.1 && share < 0.9 ? 1 : 0;
      for (int k = 0; k < 3; ++k)
      {
        const double behind = opaque->GetScalarComponentAsDouble(0, y, 0, k);
        const double over = std::lerp(behind, clear->GetScalarComponentAsDouble(x, y, 0, k), share);
        const double off = std::abs(over - opaque->GetScalarComponentAsDouble(x, y, 0, k));
        EXPECT_LT(off, 16.0) << x << ' ' << y;
        sum += off;
      }
    }
  }
  EXPECT_GT(partly, 100) << "smooth edges";
  EXPECT_LT(sum / (3.0 * 480 * 360), 0.5);
}

// letters and lines keep their share of the picture
TEST_F(PressFigure, IsTheSamePictureLarger)
{
  EXPECT_EQ(dpiOf({ .width = 1280, .height = 960 }), 72);
  EXPECT_EQ(dpiOf({ .width = 2560, .height = 1920 }), 144);
  EXPECT_EQ(dpiOf({ .width = 7680, .height = 5760 }), 432);
  EXPECT_EQ(dpiOf({ .width = 320, .height = 240 }), 72) << "never smaller than can be read";
}

TEST_F(PressFigure, HasWhatIsAskedFor)
{
  const auto plain = figure({ .hasColorBar = false });
  FigureLook look{ .hasColorBar = false };
  for (bool FigureLook::*part :
    { &FigureLook::hasAxes, &FigureLook::hasScaleBar, &FigureLook::hasCaption })
  {
    FigureLook with = look;
    with.*part = true;
    EXPECT_GT(test::differenceOf(*figure(with), *plain).changed, 0.0002);
  }
  look.overlays = { Overlay::DisplacementColors };
  FigureLook bar = look;
  bar.hasColorBar = true;
  EXPECT_GT(test::differenceOf(*figure(bar), *figure(look)).changed, 0.005);
}

TEST_F(PressFigure, CaptionTellsWhatWasPressedAndHow)
{
  const std::string caption = captionOf(moment_);
  for (const char* part : { "ball", "sphere:10mm", "50.0 kPa", "0.33", "5.00 mm", " N" })
  {
    EXPECT_NE(caption.find(part), std::string::npos) << part << " in " << caption;
  }
}

double brightness(vtkImageData& image, int x, int y)
{
  return image.GetScalarComponentAsDouble(x, y, 0, 0) +
    image.GetScalarComponentAsDouble(x, y, 0, 1) + image.GetScalarComponentAsDouble(x, y, 0, 2);
}

// the places of the picture that no body is at
void expectTheSameBackground(vtkImageData& one, vtkImageData& other)
{
  for (const auto& [x, y] : { std::pair(3, 3), { 476, 3 }, { 3, 356 }, { 476, 356 } })
  {
    EXPECT_NEAR(brightness(one, x, y), brightness(other, x, y), 6.0) << x << ' ' << y;
  }
}

// what is open to the sky stays as it is, what lies in a dent is darker
TEST_F(PressFigure, OcclusionDarkensTheDentAndLeavesTheRest)
{
  const auto plain = figure({ .hasColorBar = false });
  beforeDrawing_ = [](vtkRenderer& renderer)
  {
    renderer.GetRenderWindow()->SetMultiSamples(0); // it brings a filter of its own
    renderer.SetPass(ambientOcclusion(14.0_mm));
  };
  const auto shaded = figure({ .hasColorBar = false });
  expectTheSameBackground(*shaded, *plain);
  double change = 0.0; // about the tool's end, which is at 203, 212 from the lower left
  for (int y = 205; y < 235; ++y)
  {
    for (int x = 175; x < 230; ++x)
    {
      change += brightness(*shaded, x, y) - brightness(*plain, x, y);
    }
  }
  EXPECT_LT(change, -3000.0);
}

// the shares of red, green and blue of a region, for the colors are to be told apart
Eigen::Vector3d hueOf(vtkImageData& image, int left, int right, int low, int high)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = low; y < high; ++y)
  {
    for (int x = left; x < right; ++x)
    {
      for (int k = 0; k < 3; ++k)
      {
        sum[k] += image.GetScalarComponentAsDouble(x, y, 0, k);
      }
    }
  }
  return sum / sum.sum();
}

// tissue stays red and the deepest place yellow; what is wet mirrors the lamps
TEST_F(PressFigure, OfAWetMaterialKeepsTheColors)
{
  const FigureLook look{ .overlays = { Overlay::DisplacementColors } };
  FigureLook wet = look;
  wet.isRealistic = true;
  const auto plain = figure(look);
  const auto shaded = figure(wet);
  expectTheSameBackground(*shaded, *plain);
  for (const auto& [left, right, low, high] :
    { std::tuple(140, 240, 120, 180), { 190, 215, 215, 228 } }) // front, and the dent's floor
  {
    const Eigen::Vector3d off =
      hueOf(*shaded, left, right, low, high) - hueOf(*plain, left, right, low, high);
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 0.1) << low;
  }
  const auto brightest = [](vtkImageData& image)
  {
    double most = 0.0;
    for (int y = 100; y < 200; ++y) // front of the ball
    {
      for (int x = 120; x < 280; ++x)
      {
        most = std::max(most, brightness(image, x, y));
      }
    }
    return most;
  };
  EXPECT_GT(brightest(*shaded), brightest(*plain) + 200.0);
}

TEST_F(PressFigure, HasABaselineOfAWetMaterial)
{
  test::expectBaseline(
    *figure({ .isRealistic = true, .overlays = { Overlay::DisplacementColors } }), "figure_wet");
}

// standard deviation over mean of the brightness, of the dent and a little around
double contrastOf(vtkImageData& image)
{
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (int y = 200; y < 240; ++y)
  {
    for (int x = 170; x < 236; ++x, ++count)
    {
      const double value = brightness(image, x, y);
      sum += value;
      squares += value * value;
    }
  }
  const double mean = sum / count;
  return std::sqrt(squares / count - mean * mean) / mean;
}

// the same surface from the same place, with its lamp at the eye
TEST_F(PressFigure, ShowsADentWithMoreContrastThanThePhysicalMaterialOfTheToolkit)
{
  vtkNew<vtkRenderer> plain;
  beforeDrawing_ = [&](vtkRenderer& renderer)
  { plain->GetActiveCamera()->DeepCopy(renderer.GetActiveCamera()); };
  const FigureLook live{ .body = { .tool = ToolLook::Hidden } };
  FigureLook wet = live;
  wet.isRealistic = true;
  const double liveContrast = contrastOf(*figure(live));
  const double wetContrast = contrastOf(*figure(wet));

  vtkNew<vtkRenderer> unused;
  PressView view(*unused);
  Surroundings around(*unused);
  OtherHand other(*unused, view);
  showMoment(view, other, around, moment_);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(view.deformed());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  appearance::setColor(*actor->GetProperty(), appearance::kLiver);
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetRoughness(0.35);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(480, 360);
  plain->AddActor(actor);
  window->AddRenderer(plain);
  const double plainContrast = contrastOf(*test::imageOf(*window));
  EXPECT_GT(liveContrast, 1.2 * plainContrast);
  EXPECT_GT(wetContrast, 1.2 * plainContrast);
}

} // namespace
} // namespace palp
