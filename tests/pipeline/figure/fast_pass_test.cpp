#include "pipeline/figure/fast_pass.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

namespace palp
{
namespace
{

// a ball before a background of two colors, below a translucent one
vtkSmartPointer<vtkUnsignedCharArray> drawn(bool isFast, bool isGradient)
{
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.9, 0.5, 0.1);
  isGradient ? renderer->SetBackground2(0.1, 0.4, 0.8) : renderer->SetBackground2(0.9, 0.5, 0.1);
  renderer->SetGradientBackground(isGradient && !isFast);
  for (const double opacity : { 1.0, 0.4 })
  {
    vtkNew<vtkSphereSource> ball;
    ball->SetThetaResolution(40);
    ball->SetPhiResolution(30);
    ball->SetCenter(0.4 * opacity, 0.0, opacity);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(ball->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetOpacity(opacity);
    actor->GetProperty()->BackfaceCullingOn();
    renderer->AddActor(actor);
  }
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(160, 120);
  window->AddRenderer(renderer);
  renderer->ResetCamera();
  isFast ? renderer->SetPass(fastPass()) : void();
  window->Render();
  window->Render(); // what one picture leaves behind must not harm the next
  auto pixels = vtkSmartPointer<vtkUnsignedCharArray>::New();
  window->GetPixelData(0, 0, 159, 119, 0, pixels);
  return pixels;
}

TEST(FastPass, LooksAsTheToolkitsOwnWay)
{
  for (const bool isGradient : { true, false })
  {
    const auto ours = drawn(true, isGradient);
    const auto theirs = drawn(false, isGradient);
    int largest = 0;
    for (vtkIdType i = 0; i < ours->GetNumberOfValues(); ++i)
    {
      largest = std::max(largest, std::abs(ours->GetValue(i) - theirs->GetValue(i)));
    }
    EXPECT_LE(largest, 2) << (isGradient ? "two colors" : "one color");
  }
}

} // namespace
} // namespace palp
