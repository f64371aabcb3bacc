#include "pipeline/view/press_view.h"

#include "pipeline/model/tool_surface.h"
#include "tests/pipeline/picture.h"
#include "tests/pipeline/view/press_pictures.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <utility>
#include <vtkActor2DCollection.h>
#include <vtkCleanPolyData.h>
#include <vtkFloatArray.h>
#include <vtkMassProperties.h>
#include <vtkPointData.h>
#include <vtkScalarBarActor.h>
#include <vtkScalarsToColors.h>
#include <vtkTriangleFilter.h>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

TEST(PressView, ShowsTheLiverUnderBothTools)
{
  const Specimen body = liver();
  View sphere(body, kSphere);
  expectBaseline(*sphere.picture(body, pressed(body, kSphere, 5.0_mm)), "liver_sphere");
  View cone(body, kCone);
  expectBaseline(*cone.picture(body, pressed(body, kCone, 6.0_mm)), "liver_cone");
}

TEST(PressView, ShowsARoundDentOfASmallTool)
{
  const Specimen body = liver();
  View view(body, kSmall);
  expectBaseline(*view.picture(body, pressed(body, kSmall, 1.5_mm)), "liver_small");
}

TEST(PressView, ShowsBlockAndBall)
{
  for (const bool isBlock : { true, false })
  {
    const Specimen body = isBlock ? block() : ball();
    const std::string name = isBlock ? "block" : "ball";
    View sphere(body, kSphere);
    expectBaseline(*sphere.picture(body, pressed(body, kSphere, 5.0_mm)), name + "_sphere");
    View cone(body, kCone);
    expectBaseline(*cone.picture(body, pressed(body, kCone, 6.0_mm)), name + "_cone");
  }
}

TEST(PressView, ShowsFittedSurfaces)
{
  const auto fitted = [](const std::string& tool)
  { return FittedSurfaces::read(PALP_SHARE "/tables/" + tool + "_r10_h50_surface.csv"); };
  const std::array<std::pair<Specimen, std::string>, 3> bodies{ std::pair(block(), "block"),
    std::pair(ball(), "ball"), std::pair(liver(), "liver") };
  for (const auto& [body, name] : bodies)
  {
    View sphere(body, kSphere);
    sphere.view.setStyle({ .fitted = fitted("sphere") });
    expectBaseline(*sphere.picture(body, pressed(body, kSphere, 5.0_mm)), name + "_fitted");
    View cone(body, kCone);
    cone.view.setStyle({ .fitted = fitted("cone45") });
    expectBaseline(*cone.picture(body, pressed(body, kCone, 6.0_mm)), name + "_cone_fitted");
  }
}

TEST(PressView, IsAtRestAgainWhenTheToolHasLeft)
{
  const Specimen body = ball();
  View view(body, kSphere);
  Sample apart;
  apart.pose.apex = { 0.0, 0.0, 0.5 };
  const auto before = view.picture(body, apart);
  (void)view.picture(body, pressed(body, kSphere, 5.0_mm));
  const auto after = view.picture(body, apart);
  EXPECT_EQ(test::differenceOf(*after, *before).mean, 0.0);
}

TEST(PressView, TakesAnotherSurfaceAndAnotherTool)
{
  const Specimen first = ball();
  const Specimen second = block();
  View view(first, kSphere);
  (void)view.picture(first, pressed(first, kSphere, 5.0_mm));
  view.view.setSurface(second.surface);
  view.view.setTip(kCone);
  const auto changed = view.picture(second, pressed(second, kCone, 6.0_mm));
  View fresh(second, kCone);
  fresh.view.setLaw(ForceLaw(kSphere, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 }));
  const auto expected = fresh.picture(second, pressed(second, kCone, 6.0_mm));
  EXPECT_EQ(test::differenceOf(*changed, *expected).changed, 0.0);
}

TEST(PressView, LeavesOutOfAClosedBodyWhatNobodySees)
{
  for (const Specimen& body : { ball(), block() })
  {
    View both(body, kSphere);
    View front(body, kSphere);
    front.view.setSurface(body.surface, true);
    for (const double depth : { 0.5_mm, 5.0_mm, 12.0_mm })
    {
      const auto one = both.picture(body, pressed(body, kSphere, depth));
      const auto other = front.picture(body, pressed(body, kSphere, depth));
      EXPECT_LT(test::differenceOf(*one, *other).mean, 1e-4) << depth;
    }
  }
}

// green of the bright ground, which the red body has little of
TEST(PressView, IsSeenThroughOrCutOpenAtTheContact)
{
  const Specimen body = ball();
  const Sample sample = pressed(body, kSphere, 5.0_mm);
  View view(body, kSphere);
  view.view.setSurface(body.surface, true);
  view.view.setVisible(std::vector<Overlay>{});
  const auto greenAt = [&](int x, int y)
  { return view.picture(body, sample)->GetScalarComponentAsDouble(x, y, 0, 1); };
  constexpr int kFront[]{ 240, 60 }; // the ball's front, below the contact
  const double whole = greenAt(kFront[0], kFront[1]);
  view.view.setLook({ .isTranslucent = true });
  EXPECT_GT(greenAt(kFront[0], kFront[1]), whole + 50.0) << "the bright ground shines through";
  view.view.setLook({});
  EXPECT_EQ(greenAt(kFront[0], kFront[1]), whole);

  const auto uncut = view.picture(body, sample);
  view.view.setLook({ .isCut = true });
  const auto cut = view.picture(body, sample);
  EXPECT_GT(test::differenceOf(*cut, *uncut).changed, 0.02) << "another wall is seen";
  double box[6];
  view.view.deformed()->GetBounds(box);
  EXPECT_NEAR(box[4], -50.0_mm, 1e-4) << "what is written stays whole";
  view.view.setLook({ .hasEdges = true });
  EXPECT_GT(test::differenceOf(*view.picture(body, sample), *uncut).changed, 0.02);
}

// where an open one shows its inside
TEST(PressView, ClosesTheCutOfAClosedBody)
{
  const Specimen body = ball();
  const Sample sample = pressed(body, kSphere, 5.0_mm);
  View view(body, kSphere);
  view.view.setVisible(std::vector<Overlay>{});
  const auto spread = [&](bool isClosed)
  {
    view.view.setSurface(body.surface, isClosed);
    (void)view.picture(body, sample);
    view.view.setLook({ .isCut = true });
    const auto cut = view.picture(body, sample);
    const auto redAt = [&cut](int x, int y) { return cut->GetScalarComponentAsDouble(x, y, 0, 0); };
    double least = 255.0;
    double most = 0.0;
    for (int y = 20; y < 100; ++y)
    {
      for (int x = 180; x < 300; ++x)
      {
        least = std::min(least, redAt(x, y));
        most = std::max(most, redAt(x, y));
      }
    }
    return most - least;
  };
  EXPECT_LT(spread(true), 12.0) << "an even face";
  EXPECT_GT(spread(false), 40.0) << "its inside";
}

// as saved pictures have; what is thin and dark stands between two brighter pixels
TEST(PressView, HasNoSpecksAroundADentWhereAPixelHasSeveralSamples)
{
  const Specimen body = block();
  View view(body, kCone);
  view.window->SetMultiSamples(8);
  view.view.setVisible({ Overlay::DisplacementColors });
  view.view.setColorBar(false);
  view.view.setLook({ .tool = ToolLook::Hidden });
  const auto image = view.picture(body, pressed(body, kCone, 6.0_mm));
  int specks = 0;
  for (int y = 2; y < 358; ++y)
  {
    for (int x = 2; x < 478; ++x)
    {
      const auto red = [&](int right, int up)
      { return image->GetScalarComponentAsDouble(x + right, y + up, 0, 0); };
      const double around =
        std::max(std::min(red(-2, 0), red(2, 0)), std::min(red(0, -2), red(0, 2)));
      const bool isDent = std::abs(x - 240) < 60; // which is dark at a side
      specks += !isDent && red(0, 0) < around - 15.0 ? 1 : 0;
    }
  }
  EXPECT_EQ(specks, 0);
}

// one picture of each look of the body
TEST(PressView, HasABaselineOfEachLook)
{
  const Specimen body = liver();
  const Sample sample = pressed(body, kSphere, 5.0_mm);
  View view(body, kSphere);
  view.view.setSurface(body.surface, true);
  view.view.setVisible({ Overlay::DisplacementColors, Overlay::IsoLines, Overlay::ContactCircle });
  const std::array<std::pair<const char*, BodyLook>, 5> looks{
    { { "look_edges", { .hasEdges = true } }, { "look_translucent", { .isTranslucent = true } },
      { "look_cut", { .isCut = true } }, { "look_without_tool", { .tool = ToolLook::Hidden } },
      { "look_outline", { .tool = ToolLook::Outlined } } }
  };
  for (const auto& [name, look] : looks)
  {
    (void)view.picture(body, sample);
    view.view.setLook(look);
    expectBaseline(*view.picture(body, sample), name);
  }
  view.view.setLook({});
  vtkNew<vtkFloatArray> heights;
  heights->SetName("Stiffness");
  for (vtkIdType i = 0; i < body.surface->GetNumberOfPoints(); ++i)
  {
    heights->InsertNextValue(static_cast<float>(body.surface->GetPoint(i)[2]));
  }
  const auto* range = heights->GetRange();
  const SurfaceMap map{
    .values = heights.Get(), .title = "stiffness", .low = range[0], .high = range[1]
  };
  view.view.setMap(&map);
  expectBaseline(*view.picture(body, sample), "look_map");
  view.view.setMap(nullptr);
  view.renderer->SetBackground(0.16, 0.17, 0.19);
  view.renderer->SetBackground2(0.30, 0.32, 0.35);
  expectBaseline(*view.picture(body, sample), "look_dark");
}

vtkScalarBarActor* legendIn(vtkRenderer& renderer)
{
  vtkActor2DCollection& flat = *renderer.GetActors2D();
  flat.InitTraversal();
  while (vtkActor2D* actor = flat.GetNextActor2D())
  {
    if (auto* bar = vtkScalarBarActor::SafeDownCast(actor))
    {
      return bar;
    }
  }
  return nullptr;
}

// whatever the values of a map are, each label is another and is the very value that it stands at
TEST(PressView, LabelsOfAMapAreExact)
{
  const Specimen body = block();
  View view(body, kSphere);
  vtkNew<vtkFloatArray> values;
  values->SetName("Stiffness");
  values->SetNumberOfValues(body.surface->GetNumberOfPoints());
  values->FillValue(1.0F);
  for (const auto& [low, high] : { std::pair(1.111, 1.139), std::pair(0.5, 1.7),
         std::pair(120.0, 951.0), std::pair(2.0, 2.0), std::pair(0.00311, 0.0034) })
  {
    const SurfaceMap map{ .values = values.Get(), .title = "stiffness", .low = low, .high = high };
    view.view.setMap(&map);
    (void)view.picture(body, Sample{});
    vtkScalarBarActor* bar = legendIn(*view.renderer);
    ASSERT_NE(bar, nullptr);
    const double* range = bar->GetLookupTable()->GetRange();
    EXPECT_LE(range[0], low);
    EXPECT_GE(range[1], high);
    const int count = bar->GetNumberOfLabels();
    ASSERT_GE(count, 3);
    for (int i = 0; i < count; ++i)
    {
      const double value = range[0] + i * (range[1] - range[0]) / (count - 1);
      std::array<char, 64> text{};
      ASSERT_GT(std::snprintf(text.data(), text.size(), bar->GetLabelFormat(), value), 0);
      EXPECT_NEAR(std::atof(text.data()), value, 1e-4 * (range[1] - range[0])) << text.data();
    }
  }
}

TEST(PressView, LabelsOfADisplacementAreRound)
{
  const Specimen body = block();
  View view(body, kSphere);
  for (const auto& [depth, step] : { std::pair(2.0_mm, 0.5), std::pair(3.7_mm, 1.0),
         std::pair(5.0_mm, 1.0), std::pair(5.5_mm, 1.0), std::pair(8.0_mm, 2.0) })
  {
    (void)view.picture(body, pressed(body, kSphere, depth));
    vtkScalarBarActor* bar = legendIn(*view.renderer);
    EXPECT_NEAR(bar->GetLookupTable()->GetRange()[1] / (bar->GetNumberOfLabels() - 1), step, 1e-9);
  }
}

TEST(PressView, DrawsNoToolThatIsNowhere)
{
  const Specimen body = ball();
  View view(body, kSphere);
  Sample lost;
  lost.pose.apex.setConstant(std::numeric_limits<double>::quiet_NaN());
  lost.contact.depth = std::numeric_limits<double>::quiet_NaN();
  (void)view.picture(body, lost); // no crash, no warning
  EXPECT_EQ(view.view.deformed()->GetPointData()->GetArray("Zone")->GetRange()[1], 0.0);
}

// closed and outward: the volume of a hemisphere and its shaft
TEST(ToolSurface, HasTheToolsVolume)
{
  const double radius = 10.0_mm;
  const double length = 20.0_mm;
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(toolSurface(SphereTip{ radius }, length));
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());
  vtkNew<vtkMassProperties> mass;
  mass->SetInputConnection(clean->GetOutputPort());
  const double expected = std::numbers::pi * radius * radius * (2.0 / 3.0 * radius + length);
  EXPECT_NEAR(mass->GetVolume(), expected, 0.01 * expected);
}

} // namespace
} // namespace palp
