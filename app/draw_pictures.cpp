#include "app/draw_pictures.h"

#include "app/offscreen.h"
#include "app/surface_point.h"
#include "haptics/contact/nearest.h"
#include "haptics/error.h"
#include "pipeline/force_charts.h"
#include "pipeline/press_view.h"

#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDataArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

#include <limits>

namespace palp
{
namespace
{

constexpr ImageSize kChart{ .width = 1000, .height = 600 };

// a context that came up but draws nothing leaves every pixel alike
bool uniform(vtkImageData& image)
{
  const auto* pixels = static_cast<const unsigned char*>(image.GetScalarPointer());
  const vtkIdType components = image.GetNumberOfScalarComponents();
  for (vtkIdType i = components; i < image.GetNumberOfPoints() * components; ++i)
  {
    if (pixels[i] != pixels[i - components])
    {
      return false;
    }
  }
  return true;
}

void writePng(vtkRenderWindow& window, const std::filesystem::path& file)
{
  window.Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(&window);
  grab->ReadFrontBufferOff();
  grab->Update();
  if (uniform(*grab->GetOutput()))
  {
    throw Error(ErrorCode::NoPicture,
      file.string() +
        ": the picture came out empty; check the OpenGL driver, or pass --no-picture");
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputConnection(grab->GetOutputPort());
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    throw Error(
      ErrorCode::BadFile, file.string() + ": cannot be written; check space and permissions");
  }
}

// where the camera looks: the deepest place, or where the tool came closest
SurfacePoint subject(const Recording& recording, const Sample& shown)
{
  if (shown.contact.touching())
  {
    return { shown.contact.center, shown.contact.normal };
  }
  const Surface& surface = *recording.scene.surface;
  const Nearest nearest =
    findNearest(surface, shown.pose.apex, std::numeric_limits<double>::infinity());
  return surfacePoint(surface, nearest.triangle, nearest.point);
}

void drawScene(const OffscreenContext& context, const Body& body, const Recording& recording,
  const ExtentTable& extents, const std::filesystem::path& file, ImageSize size)
{
  const auto window = context.makeWindow(size.width, size.height);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  PressView view(*renderer);
  view.setSurface(body.display);
  view.setTip(recording.scene.law.tip());
  view.setExtents(extents);
  const Sample* deepest = recording.deepest();
  const Sample& shown = deepest ? *deepest : recording.samples.back();
  const SurfacePoint place = subject(recording, shown);
  view.show(shown);
  view.lookAt(place.position, place.normal);
  view.show(shown); // labels take their place from the camera
  writePng(*window, file);
}

template <typename Add>
void drawChart(const OffscreenContext& context, const std::filesystem::path& file, Add add)
{
  const auto window = context.makeWindow(kChart.width, kChart.height);
  vtkNew<vtkContextView> view;
  view->SetRenderWindow(window);
  view->GetRenderer()->SetBackground(1.0, 1.0, 1.0);
  add(*view->GetScene());
  writePng(*window, file);
}

} // namespace

void DrawPictures::drawPress(const Body& body, const Recording& recording,
  const ExtentTable& extents, const std::filesystem::path& directory, ImageSize size) const
{
  const OffscreenContext context;
  drawScene(context, body, recording, extents, directory / "press.png", size);

  ForceCharts charts;
  charts.setLaw(recording.scene.law);
  for (const Sample& sample : recording.samples)
  {
    charts.add(sample);
  }
  charts.refresh();
  drawChart(context, directory / "force_time.png",
    [&](vtkContextScene& scene) { charts.addForceOverTime(scene); });
  drawChart(context, directory / "force_depth.png",
    [&](vtkContextScene& scene) { charts.addForceOverDepth(scene); });
}

} // namespace palp
