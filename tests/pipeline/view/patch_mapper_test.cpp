#include "pipeline/view/vtkPalpPatchMapper.h"

#include "haptics/units.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "tests/pipeline/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCamera.h>

#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kRadius = 50.0_mm;

Press pressOnTop(double depth, double aside = 0.0)
{
  const Eigen::Vector3d normal = Eigen::Vector3d(std::sin(aside), 0.0, std::cos(aside));
  return test::pressAt(kRadius * normal, normal, SphereTip{ 10.0_mm }, depth, 15.0_mm);
}

// a surface in a window, drawn by a given mapper
struct Scene
{
  explicit Scene(vtkPolyDataMapper* mapper)
  {
    ball->SetRadius(kRadius);
    ball->SetThetaResolution(160);
    ball->SetPhiResolution(120);
    filter->SetInputConnection(ball->GetOutputPort());
    mapper->SetInputConnection(filter->GetOutputPort());
    mapper->ScalarVisibilityOff();
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(0.7, 0.3, 0.25);
    renderer->AddActor(actor);
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(200, 160);
    window->AddRenderer(renderer);
    renderer->GetActiveCamera()->SetPosition(0.0, -0.15, 0.2);
    renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
    renderer->GetActiveCamera()->SetClippingRange(0.05, 1.0);
  }

  void draw(const Press& press)
  {
    filter->SetPress(press);
    window->Render();
  }

  vtkSmartPointer<vtkUnsignedCharArray> pixels()
  {
    auto values = vtkSmartPointer<vtkUnsignedCharArray>::New();
    window->GetPixelData(0, 0, 199, 159, 0, values);
    return values;
  }

  vtkNew<vtkSphereSource> ball;
  vtkNew<vtkPalpDeformFilter> filter;
  vtkNew<vtkActor> actor;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
};

// pixels that differ by more than a rounding
int differences(vtkUnsignedCharArray* a, vtkUnsignedCharArray* b)
{
  int count = 0;
  for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i)
  {
    count += std::abs(a->GetValue(i) - b->GetValue(i)) > 2 ? 1 : 0;
  }
  return count;
}

TEST(PatchMapper, DrawsWhatTheToolkitsMapperDraws)
{
  vtkNew<vtkPalpPatchMapper> ours;
  vtkNew<vtkPolyDataMapper> theirs;
  Scene quick(ours);
  Scene plain(theirs);
  vtkSmartPointer<vtkUnsignedCharArray> atRest;
  // dented, moved on, released
  for (const Press& press :
    { Press{}, pressOnTop(4.0_mm), pressOnTop(6.0_mm, 0.3), pressOnTop(2.0_mm, -0.2), Press{} })
  {
    quick.draw(press);
    plain.draw(press);
    const auto image = quick.pixels();
    EXPECT_LE(differences(image, plain.pixels()), 20);
    if (!atRest)
    {
      atRest = image;
    }
    else if (press.contact.touching())
    {
      EXPECT_GT(differences(image, atRest), 500);
    }
  }
  EXPECT_EQ(differences(quick.pixels(), atRest), 0);
}

TEST(PatchMapper, SendsNoMoreThanTheDent)
{
  vtkNew<vtkPalpPatchMapper> mapper;
  Scene scene(mapper);
  scene.draw(Press{});
  const vtkIdType all = scene.filter->GetOutput()->GetNumberOfPoints() * 24;
  EXPECT_EQ(mapper->GetSentBytes(), all);
  scene.draw(pressOnTop(1.0_mm, 90.0_deg)); // at the side: the source numbers along meridians
  EXPECT_GT(mapper->GetSentBytes(), 0);
  EXPECT_LT(mapper->GetSentBytes(), all / 4);
  scene.window->Render(); // nothing new
  EXPECT_EQ(mapper->GetSentBytes(), 0);
  scene.draw(Press{}); // back to rest
  EXPECT_GT(mapper->GetSentBytes(), 0);
  scene.draw(Press{});
  EXPECT_EQ(mapper->GetSentBytes(), 0);
}

// without lights a shader has no normals
TEST(PatchMapper, DrawsWithoutLight)
{
  vtkNew<vtkPalpPatchMapper> ours;
  vtkNew<vtkPolyDataMapper> theirs;
  Scene quick(ours);
  Scene plain(theirs);
  for (Scene* scene : { &quick, &plain })
  {
    scene->actor->GetProperty()->LightingOff();
    scene->draw(pressOnTop(4.0_mm));
  }
  EXPECT_LE(differences(quick.pixels(), plain.pixels()), 20);
}

// a transformed surface shares its triangles with the one before
TEST(PatchMapper, BoundsFollowPointsThatAreReplaced)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(kRadius);
  ball->Update();
  vtkNew<vtkPolyData> moved;
  moved->ShallowCopy(ball->GetOutput());
  vtkNew<vtkPoints> points;
  points->DeepCopy(moved->GetPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Eigen::Vector3d point(points->GetPoint(i));
    point.x() += 1.0;
    points->SetPoint(i, point.data());
  }
  moved->SetPoints(points);
  vtkNew<vtkPalpDeformFilter> filter;
  vtkNew<vtkPalpPatchMapper> mapper;
  mapper->SetInputConnection(filter->GetOutputPort());
  for (vtkPolyData* surface : { ball->GetOutput(), moved.Get() })
  {
    filter->SetInputDataObject(surface);
    const double* bounds = mapper->GetBounds();
    const double middle = 0.5 * (bounds[0] + bounds[1]);
    EXPECT_NEAR(middle, surface == moved.Get() ? 1.0 : 0.0, 1e-3);
  }
}

TEST(PatchMapper, SendsEverythingForAnotherSurface)
{
  vtkNew<vtkPalpPatchMapper> mapper;
  Scene scene(mapper);
  scene.draw(pressOnTop(3.0_mm));
  scene.ball->SetThetaResolution(80);
  scene.draw(pressOnTop(3.0_mm));
  EXPECT_EQ(mapper->GetSentBytes(), scene.filter->GetOutput()->GetNumberOfPoints() * 24);
}

// two windows that show the same output at different rates
TEST(PatchMapper, CatchesUpAfterUpdatesItDidNotDraw)
{
  vtkNew<vtkPalpPatchMapper> ours;
  vtkNew<vtkPolyDataMapper> theirs;
  Scene quick(ours);
  Scene plain(theirs);
  quick.draw(pressOnTop(3.0_mm, 0.3));
  for (const double aside : { 0.2, 0.0, -0.3 })
  {
    quick.filter->SetPress(pressOnTop(3.0_mm, aside));
    quick.filter->Update();
  }
  quick.window->Render();
  plain.draw(pressOnTop(3.0_mm, -0.3));
  EXPECT_LE(differences(quick.pixels(), plain.pixels()), 20);
}

TEST(PatchMapper, LeavesOutTheDentThatIsDrawnByItself)
{
  vtkNew<vtkPalpPatchMapper> ours;
  vtkNew<vtkPolyDataMapper> theirs;
  Scene apart(ours);
  Scene plain(theirs);
  apart.filter->GeneratePatchOn();
  apart.filter->SetPatchLevel(0);
  vtkNew<vtkPolyDataMapper> patch;
  patch->SetInputConnection(apart.filter->GetOutputPort(1));
  patch->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(patch);
  actor->SetProperty(apart.actor->GetProperty());
  ours->SetHideDent(true);
  plain.draw(pressOnTop(4.0_mm));
  apart.draw(pressOnTop(4.0_mm));
  EXPECT_GT(differences(apart.pixels(), plain.pixels()), 1000); // a hole
  apart.renderer->AddActor(actor);
  apart.draw(pressOnTop(4.0_mm));
  EXPECT_LE(differences(apart.pixels(), plain.pixels()), 100); // filled
  ours->SetHideDent(false);
  actor->VisibilityOff();
  apart.window->Render();
  EXPECT_LE(differences(apart.pixels(), plain.pixels()), 20);
}

TEST(PatchMapper, HasBoundsThatDoNotFollowTheDent)
{
  vtkNew<vtkPalpPatchMapper> mapper;
  Scene scene(mapper);
  double before[6];
  mapper->GetBounds(before);
  EXPECT_NEAR(before[5], kRadius + mapper->GetPadding(), 1e-6);
  scene.draw(pressOnTop(4.0_mm));
  double after[6];
  mapper->GetBounds(after);
  EXPECT_TRUE(std::equal(before, before + 6, after));
}

} // namespace
} // namespace palp
