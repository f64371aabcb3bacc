#include "pipeline/charts/comparison.h"
#include "pipeline/view/control_net.h"
#include "pipeline/view/force_arrow.h"
#include "pipeline/view/iso_lines.h"
#include "tests/pipeline/picture.h"
#include "tests/pipeline/view/press_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>
#include <vtkActor2DCollection.h>
#include <vtkBoundingBox.h>
#include <vtkMapper.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

// each overlay alone
class EachOverlay : public ::testing::TestWithParam<std::pair<Overlay, const char*>>
{
};
INSTANTIATE_TEST_SUITE_P(PressView, EachOverlay,
  ::testing::Values(std::pair{ Overlay::ForceArrow, "arrow" },
    std::pair{ Overlay::ContactCircle, "contact_circle" },
    std::pair{ Overlay::ExtentCircle, "extent_circle" },
    std::pair{ Overlay::DisplacementColors, "displacement" },
    std::pair{ Overlay::Readings, "readings" }, std::pair{ Overlay::PressureColors, "pressure" },
    std::pair{ Overlay::ValidityColors, "validity" }, std::pair{ Overlay::ControlNet, "net" },
    std::pair{ Overlay::Ghost, "ghost" }, std::pair{ Overlay::IsoLines, "iso_lines" }));

TEST_P(EachOverlay, IsDrawnWhenWantedAndNotOtherwise)
{
  const Specimen body = ball();
  View view(body, kSphere);
  for (std::size_t i = 0; i < kOverlayCount; ++i)
  {
    view.view.setVisible(static_cast<Overlay>(i), false);
  }
  const Sample sample = pressed(body, kSphere, 5.0_mm);
  const auto plain = view.picture(body, sample);
  view.view.setVisible(GetParam().first, true);
  const auto with = view.picture(body, sample);
  EXPECT_GT(test::differenceOf(*with, *plain).changed, 0.0005);
  expectBaseline(*with, std::string("overlay_") + GetParam().second);
  view.view.setVisible(GetParam().first, false);
  EXPECT_EQ(test::differenceOf(*view.picture(body, sample), *plain).mean, 0.0);
}

TEST(PressView, NamesTheRuleThatColorsTheDent)
{
  const Specimen body = ball();
  View view(body, kSphere);
  view.view.setVisible(std::vector{ Overlay::ValidityColors, Overlay::Readings });
  expectBaseline(*view.picture(body, pressed(body, kSphere, 5.0_mm)), "validity_rule");
}

TEST(SectionPlot, ShowsFig5OnABall)
{
  const Specimen body = ball();
  View view(body, kSphere);
  view.view.show(pressed(body, kSphere, 5.0_mm));
  std::vector<std::unique_ptr<Plot>> plots;
  plots.push_back(sectionPlot(view.view.press(), Eigen::Vector3d::UnitX(),
    FittedSurfaces::read(PALP_SHARE "/tables/sphere_r10_h50_surface.csv").at(5.0_mm)));
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(480, 360);
  showPlots(*window, plots);
  expectBaseline(*test::imageOf(*window), "section");
}

TEST(ControlNet, LiesOnTheToolAndOnTheSurface)
{
  const Specimen body = block();
  View view(body, kSphere);
  view.view.show(pressed(body, kSphere, 5.0_mm));
  vtkNew<vtkPolyData> net;
  fillControlNet(view.view.press().GetDent(), *net);
  ASSERT_EQ(net->GetNumberOfPoints(), 3 * PressField::kDirections);
  const Eigen::Vector3d center(0.0, 0.0, 30.0_mm); // of the sphere
  for (vtkIdType i = 0; i < net->GetNumberOfPoints(); ++i)
  {
    Eigen::Vector3d point;
    net->GetPoint(i, point.data());
    if (i % 3 == 0)
    {
      EXPECT_NEAR((point - center).norm(), 10.0_mm, 0.5_um); // P0 on the tool
    }
    else
    {
      EXPECT_NEAR(point.z(), 25.0_mm, 0.5_um); // P1 and P2 on the tangent L1
    }
  }
}

struct Box
{
  double low[2];
  double high[2];
};

// of all texts that are shown [pixels]
std::vector<Box> shownTexts(vtkRenderer& renderer)
{
  std::vector<Box> boxes;
  vtkActor2DCollection& actors = *renderer.GetActors2D();
  actors.InitTraversal();
  while (vtkActor2D* actor = actors.GetNextActor2D())
  {
    auto* text = vtkTextActor::SafeDownCast(actor);
    if (text != nullptr && text->GetVisibility() != 0)
    {
      double box[4]; // from its position
      text->GetBoundingBox(&renderer, box);
      const double* at = text->GetPosition();
      boxes.push_back({ { at[0] + box[0], at[1] + box[2] }, { at[0] + box[1], at[1] + box[3] } });
    }
  }
  return boxes;
}

// a small window, and a screen of twice the dots per inch
TEST(PressView, KeepsItsTextsInThePictureAndApart)
{
  const Specimen body = ball();
  for (const auto& [width, height, dpi] : { std::array{ 480, 360, 72 }, { 375, 700, 72 },
         { 340, 360, 72 }, { 960, 720, 144 }, { 750, 1400, 144 } })
  {
    View view(body, kSphere);
    view.window->SetSize(width, height);
    view.window->SetDPI(dpi);
    view.view.setVisible(std::vector{ Overlay::ForceArrow, Overlay::ContactCircle,
      Overlay::ExtentCircle, Overlay::Readings, Overlay::DisplacementColors });
    for (const double depth : { 2.0_mm, 15.0_mm })
    {
      view.picture(body, pressed(body, kSphere, depth));
      const std::vector<Box> texts = shownTexts(*view.renderer);
      ASSERT_EQ(texts.size(), 5U); // of the arrow its force and its rings
      for (std::size_t i = 0; i < texts.size(); ++i)
      {
        EXPECT_GE(texts[i].low[0], 0.0) << width << " text " << i;
        EXPECT_LE(texts[i].high[0], width) << width << " text " << i;
        EXPECT_GE(texts[i].low[1], 0.0) << width << " text " << i;
        EXPECT_LE(texts[i].high[1], height) << width << " text " << i;
        for (std::size_t k = 0; k < i; ++k)
        {
          EXPECT_TRUE(texts[i].low[1] > texts[k].high[1] || texts[k].low[1] > texts[i].high[1])
            << width << " at " << dpi << " dpi, texts " << k << " and " << i;
        }
      }
    }
  }
}

// the whole liver in sight, as in a small window
TEST(PressView, CoversNoBodyWithItsColorBarInANarrowPicture)
{
  const Specimen body = liver();
  View view(body, kSphere);
  view.window->SetSize(376, 724);
  view.picture(body, pressed(body, kSphere, 5.0_mm));
  view.renderer->ResetCamera(body.surface->GetBounds());
  view.window->Render();
  double top = 0.0; // of the body [-] of the picture
  for (vtkIdType i = 0; i < body.surface->GetNumberOfPoints(); ++i)
  {
    view.renderer->SetWorldPoint(body.surface->GetPoint(i)[0], body.surface->GetPoint(i)[1],
      body.surface->GetPoint(i)[2], 1.0);
    view.renderer->WorldToDisplay();
    top = std::max(top, view.renderer->GetDisplayPoint()[1] / 724.0);
  }
  vtkActor2DCollection& flat = *view.renderer->GetActors2D();
  flat.InitTraversal();
  int bars = 0;
  while (vtkActor2D* actor = flat.GetNextActor2D())
  {
    if (vtkScalarBarActor::SafeDownCast(actor) != nullptr && actor->GetVisibility() != 0)
    {
      ++bars;
      EXPECT_GT(actor->GetPosition()[1], top);
    }
  }
  EXPECT_EQ(bars, 1);
}

// the actor is known by its color
const double* boundsOfArrow(vtkRenderer& renderer)
{
  vtkActorCollection& actors = *renderer.GetActors();
  actors.InitTraversal();
  while (vtkActor* actor = actors.GetNextActor())
  {
    const double* color = actor->GetProperty()->GetDiffuseColor();
    if (std::equal(color, color + 3, appearance::kForce.begin()))
    {
      return actor->GetBounds();
    }
  }
  static constexpr double kNone[6]{};
  return kNone;
}

double lengthOfArrow(vtkRenderer& renderer)
{
  return vtkBoundingBox(boundsOfArrow(renderer)).GetDiagonalLength();
}

// at any depth a few lines, at round numbers of millimeters
TEST(IsoLines, AreFewAndAtRoundNumbers)
{
  EXPECT_NEAR(IsoLines::stepOf(2.0_mm), 0.5_mm, 1e-9);
  EXPECT_NEAR(IsoLines::stepOf(5.0_mm), 1.0_mm, 1e-9);
  EXPECT_NEAR(IsoLines::stepOf(8.0_mm), 1.0_mm, 1e-9);
  for (double depth = 0.01_mm; depth < 50.0_mm; depth *= 1.03)
  {
    const double lines = depth / IsoLines::stepOf(depth);
    EXPECT_LE(lines, 8.0 + 1e-6) << depth;
    EXPECT_GE(lines, 3.0) << depth;
  }
}

TEST(IsoLines, RunWhereTheSurfaceMovedAsFar)
{
  const Specimen body = ball();
  View view(body, kSphere);
  view.picture(body, pressed(body, kSphere, 5.0_mm));
  vtkActorCollection& actors = *view.renderer->GetActors();
  actors.InitTraversal();
  int points = 0;
  while (vtkActor* actor = actors.GetNextActor())
  {
    const double* color = actor->GetProperty()->GetDiffuseColor();
    if (!std::equal(color, color + 3, appearance::kInk.begin()))
    {
      continue;
    }
    vtkPolyData& lines = *vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput());
    vtkDataArray& moved = *lines.GetPointData()->GetArray("Displacement");
    for (vtkIdType i = 0; i < lines.GetNumberOfPoints(); ++i, ++points)
    {
      const double* by = moved.GetTuple3(i);
      const double mm = units::toMillimeters(std::hypot(by[0], by[1], by[2]));
      EXPECT_NEAR(mm, std::round(mm), 0.05) << mm; // between corners its length is not linear
      EXPECT_GE(std::round(mm), 1.0);
    }
  }
  EXPECT_GT(points, 100);
}

// the shaft is a ruler, to one scale while it fits
TEST(ForceArrow, IsAsLongAsTheForceIsLarge)
{
  constexpr double kDiagonal = 250.0_mm;
  const double none = ForceArrow::lengthOf(0.0, kDiagonal);
  EXPECT_NEAR(ForceArrow::lengthOf(2.0, kDiagonal) - none, 30.0_mm, 1e-9); // 15 mm/N
  EXPECT_NEAR(ForceArrow::lengthOf(4.0, kDiagonal) - none, 60.0_mm, 1e-9);
  for (double force = 1e-3; force < 1e6; force *= 1.5)
  {
    const ForceArrow::Scale scale = ForceArrow::scaleOf(force, kDiagonal);
    EXPECT_LE(force * scale.length, 0.27 * kDiagonal + 1e-9) << force;
    const double ring = scale.ring * scale.length; // of rings that can be told apart
    EXPECT_GE(ring, 0.02 * kDiagonal - 1e-9) << force;
    EXPECT_LE(ring, 0.05 * kDiagonal + 1e-9) << force;
  }
}

// and what is pressed is seen, whatever side it is looked at from
TEST(ForceArrow, StandsBesideTheTool)
{
  const Specimen body = ball();
  for (const Tip& tip : { kSphere, kSmall })
  {
    View view(body, tip);
    view.picture(body, pressed(body, tip, 2.0_mm));
    for (const double angle : { 0.0, 1.0, 2.0, 4.0 })
    {
      view.renderer->GetActiveCamera()->Azimuth(units::toDegrees(angle));
      view.window->Render();
      const double* box = boundsOfArrow(*view.renderer);
      const Eigen::Vector2d middle(0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]));
      EXPECT_GT(middle.norm(), 1.2 * baseRadius(tip)) << angle;
    }
  }
}

// the same press with a tool that is larger than the body
TEST(ForceArrow, StaysSmallAgainstTheBodyWhateverTheToolAndTheForce)
{
  const Specimen body = ball();
  const double diagonal = body.surface->GetLength();
  for (const double radius : { 1.0_mm, 10.0_mm, 125.0_mm, 1000.0_mm })
  {
    View view(body, SphereTip{ radius });
    for (const double depth : { 0.1_mm, 5.0_mm, 30.0_mm })
    {
      view.picture(body, pressed(body, SphereTip{ radius }, depth));
      EXPECT_LT(lengthOfArrow(*view.renderer), 0.35 * diagonal) << radius << ", " << depth;
      EXPECT_GT(lengthOfArrow(*view.renderer), 0.04 * diagonal) << radius << ", " << depth;
    }
  }
}

} // namespace
} // namespace palp
