#pragma once

#include "app/plots/press_figure.h"
#include "haptics/units.h"
#include "tests/pipeline/view/press_pictures.h"
#include "tests/support/process.h"

#include <functional>
#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkRenderWindow.h>

namespace palp::test
{

using namespace units::literals;

/// A ball that a sphere presses, to be drawn.
class PressFigure : public ::testing::Test
{
protected:
  [[nodiscard]] vtkSmartPointer<vtkImageData> figure(
    const FigureLook& look, int width = 480, int height = 360)
  {
    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetSize(width, height);
    const std::filesystem::path file = folder_.path() / "figure.png";
    writeFigure(
      *window, moment_, look,
      [this](PressView& view, vtkRenderer& renderer)
      {
        view.lookAtWhole(ball_.position, ball_.normal);
        beforeDrawing_(renderer);
      },
      file);
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
  }

  [[nodiscard]] static SceneBody named(vtkPolyData* surface)
  {
    SceneBody body;
    body.name = "ball";
    body.display = surface;
    return body;
  }

  [[nodiscard]] static Calibration ofThreeDepths()
  {
    Calibration calibration{ .extents = ExtentTable(
                               { { 1.0_mm, 3.5_mm, 0.2, 3.0_mm }, { 5.0_mm, 18.4_mm, 2.9, 7.0_mm },
                                 { 10.0_mm, 30.0_mm, 8.0, 10.0_mm } }),
      .style = {},
      .note = {},
      .elements = {},
      .young = {} };
    return calibration;
  }

  std::function<void(vtkRenderer&)> beforeDrawing_ = [](vtkRenderer&) {};
  TemporaryFolder folder_;
  const Specimen ball_ = ball();
  const SceneBody body_ = named(ball_.surface);
  const ForceLaw law_{ kSphere, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 } };
  const Calibration calibration_ = ofThreeDepths();
  const Sample sample_ = pressed(ball_, kSphere, 5.0_mm);
  PressMoment moment_{ body_, law_, calibration_, sample_ };
};

} // namespace palp::test
