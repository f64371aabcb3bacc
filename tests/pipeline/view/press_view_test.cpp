#include "pipeline/view/press_view.h"

#include "haptics/units.h"
#include "pipeline/charts/comparison.h"
#include "pipeline/view/control_net.h"
#include "pipeline/view/tool_surface.h"
#include "tests/pipeline/picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>
#include <vtkCamera.h>
#include <vtkCleanPolyData.h>
#include <vtkCubeSource.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkMassProperties.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

namespace palp
{
namespace
{

using namespace units::literals;

struct Body
{
  vtkSmartPointer<vtkPolyData> surface;
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
};

Body liver()
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(PALP_SHARE "/meshes/liver.vtp");
  vtkNew<vtkTransform> toMetres;
  const double metre = units::fromMillimetres(1.0);
  toMetres->Scale(metre, metre, metre);
  vtkNew<vtkTransformPolyDataFilter> scaled;
  scaled->SetTransform(toMetres);
  scaled->SetInputConnection(reader->GetOutputPort());
  scaled->Update();
  // the highest point
  Body body{ scaled->GetOutput(), { 0.0, 0.0, -1.0 }, Eigen::Vector3d::UnitZ() };
  for (vtkIdType i = 0; i < body.surface->GetNumberOfPoints(); ++i)
  {
    double point[3];
    body.surface->GetPoint(i, point);
    if (point[2] > body.place.z())
    {
      body.place = Eigen::Vector3d(point[0], point[1], point[2]);
    }
  }
  return body;
}

Body ball()
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(50.0_mm);
  source->SetThetaResolution(120);
  source->SetPhiResolution(90);
  source->Update();
  return { source->GetOutput(), { 0.0, 0.0, 50.0_mm }, Eigen::Vector3d::UnitZ() };
}

Body block()
{
  vtkNew<vtkCubeSource> cube;
  cube->SetXLength(100.0_mm);
  cube->SetYLength(100.0_mm);
  cube->SetZLength(50.0_mm);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(cube->GetOutputPort());
  vtkNew<vtkLinearSubdivisionFilter> finer;
  finer->SetInputConnection(triangles->GetOutputPort());
  finer->SetNumberOfSubdivisions(6);
  finer->Update();
  return { finer->GetOutput(), { 0.0, 0.0, 25.0_mm }, Eigen::Vector3d::UnitZ() };
}

const Tip kSphere = SphereTip{ 10.0_mm };
const Tip kCone = ConeTip{ 45.0_deg, 10.0_mm };
const Tip kSmall = SphereTip{ 3.0_mm };

Sample pressed(const Body& body, const Tip& tip, double depth)
{
  const ForceLaw law(tip, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 });
  Sample sample;
  sample.contact = { .depth = depth, .normal = body.normal, .center = body.place };
  sample.pose = { .apex = body.place - depth * body.normal, .axis = -body.normal };
  sample.response = law({ .depth = depth });
  return sample;
}

struct View
{
  explicit View(const Body& body, const Tip& tip)
    : view(*renderer)
    , tool(tip)
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(480, 360);
    window->AddRenderer(renderer);
    view.setSurface(body.surface);
    view.setTip(tip);
    view.setLaw(ForceLaw(tip, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 }));
    view.setExtents(ExtentTable({ { 1.0_mm, 3.5_mm, 0.2, 3.0_mm }, { 5.0_mm, 18.4_mm, 2.9, 7.0_mm },
      { 10.0_mm, 30.0_mm, 8.0, 10.0_mm } }));
  }

  vtkSmartPointer<vtkImageData> picture(const Body& body, const Sample& sample)
  {
    view.show(sample);
    lookAt(body);
    return test::imageOf(*window);
  }

  // 50 degrees from the normal, which shows into the dent and along the arrow; from the front, so
  // that the view does not roll with the normal
  void lookAt(const Body& body)
  {
    const double base = baseRadius(tool);
    const double diagonal = body.surface->GetLength();
    const double height =
      std::max(9.0 * base, std::clamp(14.0 * base, 0.2 * diagonal, 0.45 * diagonal));
    const double distance = 0.5 * height / std::tan(15.0_deg);
    Eigen::Vector3d side = -Eigen::Vector3d::UnitY() + body.normal.y() * body.normal;
    side = side.norm() > 0.3 ? side.normalized() : body.normal.unitOrthogonal();
    const Eigen::Vector3d towards = std::cos(50.0_deg) * body.normal + std::sin(50.0_deg) * side;
    const Eigen::Vector3d focus = body.place + 0.12 * height * body.normal;
    const Eigen::Vector3d eye = focus + distance * towards;
    vtkCamera& camera = *renderer->GetActiveCamera();
    camera.SetFocalPoint(focus.data());
    camera.SetPosition(eye.data());
    camera.SetViewUp(body.normal.data());
    renderer->ResetCameraClippingRange();
  }

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  PressView view;
  Tip tool;
};

void expectBaseline(vtkImageData& image, const std::string& name)
{
  const test::Difference difference = test::differenceFromBaseline(image, name);
  EXPECT_LT(difference.mean, 1.5) << name;
  EXPECT_LT(difference.changed, 0.01) << name;
}

TEST(PressView, ShowsTheLiverUnderBothTools)
{
  const Body body = liver();
  View sphere(body, kSphere);
  expectBaseline(*sphere.picture(body, pressed(body, kSphere, 5.0_mm)), "liver_sphere");
  View cone(body, kCone);
  expectBaseline(*cone.picture(body, pressed(body, kCone, 6.0_mm)), "liver_cone");
}

TEST(PressView, ShowsARoundDentOfASmallTool)
{
  const Body body = liver();
  View view(body, kSmall);
  expectBaseline(*view.picture(body, pressed(body, kSmall, 1.5_mm)), "liver_small");
}

TEST(PressView, ShowsBlockAndBall)
{
  for (const bool isBlock : { true, false })
  {
    const Body body = isBlock ? block() : ball();
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
  const std::array<std::pair<Body, std::string>, 3> bodies{ std::pair(block(), "block"),
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

TEST(PressView, NamesTheRuleThatColoursTheDent)
{
  const Body body = ball();
  View view(body, kSphere);
  view.view.setVisible(std::vector{ Overlay::ValidityColors, Overlay::Readings });
  expectBaseline(*view.picture(body, pressed(body, kSphere, 5.0_mm)), "validity_rule");
}

TEST(SectionPlot, ShowsFig5OnABall)
{
  const Body body = ball();
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
    std::pair{ Overlay::Ghost, "ghost" }));

TEST_P(EachOverlay, IsDrawnWhenWantedAndNotOtherwise)
{
  const Body body = ball();
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

TEST(PressView, IsAtRestAgainWhenTheToolHasLeft)
{
  const Body body = ball();
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
  const Body first = ball();
  const Body second = block();
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

TEST(PressView, DrawsNoToolThatIsNowhere)
{
  const Body body = ball();
  View view(body, kSphere);
  Sample lost;
  lost.pose.apex.setConstant(std::numeric_limits<double>::quiet_NaN());
  lost.contact.depth = std::numeric_limits<double>::quiet_NaN();
  (void)view.picture(body, lost); // no crash, no warning
  EXPECT_EQ(view.view.deformed()->GetPointData()->GetArray("Zone")->GetRange()[1], 0.0);
}

TEST(ControlNet, LiesOnTheToolAndOnTheSurface)
{
  const Body body = block();
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

// of the arrow, from its colour
double lengthOfArrow(vtkRenderer& renderer)
{
  vtkActorCollection& actors = *renderer.GetActors();
  actors.InitTraversal();
  while (vtkActor* actor = actors.GetNextActor())
  {
    const double* color = actor->GetProperty()->GetDiffuseColor();
    if (std::equal(color, color + 3, appearance::kForce.begin()))
    {
      return actor->GetLength();
    }
  }
  return 0.0;
}

// the same press with a tool that is larger than the body
TEST(ForceArrow, StaysSmallAgainstTheBodyWhateverTheToolAndTheForce)
{
  const Body body = ball();
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
