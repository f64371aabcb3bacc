#include "app/bench/bench_dome.h"
#include "app/draw/offscreen.h"
#include "app/draw/offscreen_renderer.h"
#include "haptics/units.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/view/press_view.h"
#include "pipeline/view/vtkPalpPatchMapper.h"

#include <algorithm>
#include <functional>
#include <vtkActor.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLIndexBufferObject.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtk_glew.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kSteps = 20; // frames of the tool's way to one side

// Draws some of the triangles, of all the points that it keeps in graphics memory. Software takes
// 100 ms to draw a million, and what differs between two such pictures is not to be seen beside it.
class SomeTriangles : public vtkPalpPatchMapper
{
public:
  static SomeTriangles* New();
  vtkTypeMacro(SomeTriangles, vtkPalpPatchMapper);

protected:
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override
  {
    constexpr std::size_t kMost = 30'000; // corners
    std::size_t& count = Primitives[PrimitiveTris].IBO->IndexCount;
    const std::size_t all = count;
    count = std::min(count, kMost);
    vtkPalpPatchMapper::RenderPieceDraw(renderer, actor);
    count = all;
  }
};
vtkStandardNewMacro(SomeTriangles);

// where pictures are drawn, and how many of each kind
struct Setting
{
  OffscreenContext context;
  int frames;
};

struct Frames
{
  std::vector<double> still; ///< a picture drawn again [us]
  std::vector<double> above; ///< how much longer one with a moved dent takes [us]
};

// in turns, for other work on the machine comes and goes
Frames measure(int count, vtkRenderWindow& window, const std::function<void(int)>& move)
{
  const auto draw = [&]
  {
    window.Render();
    glFinish();
  };
  const auto drawMoved = [&](int i)
  {
    move(i);
    draw();
  };
  for (int i = 0; i < kSteps; ++i)
  {
    drawMoved(i);
  }
  Frames frames;
  const auto redraw = [&](int)
  {
    const auto begin = std::chrono::steady_clock::now();
    draw();
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
    frames.still.push_back(time.count());
  };
  frames.above = timed(count, redraw, drawMoved);
  std::transform(frames.above.begin(), frames.above.end(), frames.still.begin(),
    frames.above.begin(), std::minus<>());
  return frames;
}

// where the tool is in a frame, there and back [m]
double offsetOf(int frame, double outer)
{
  const int step = frame % kSteps - kSteps / 2;
  return 0.05 * outer * step;
}

// the surface alone
std::vector<BenchRow> benchSurface(
  const Setting& setting, const BenchDome& dome, double touched, const char* mode)
{
  const Mesh mesh = dome.mesh();
  const double outer = dome.radiusOf(touched);
  vtkNew<vtkPalpDeformFilter> press;
  press->SetInputDataObject(makePolyData(mesh.points, mesh.triangles));
  vtkNew<SomeTriangles> mapper;
  mapper->SetInputConnection(press->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const auto window = setting.context.makeWindow(160, 120);
  window->AddRenderer(renderer);
  const Frames frames = measure(setting.frames, *window,
    [&](int i) { press->SetPress(dome.press(outer, offsetOf(i, outer))); });
  return { benchRow("frame", mesh.points.size(), "still", frames.still),
    benchRow("frame", mesh.points.size(), mode, frames.above) };
}

// the whole view of a dent of 500 points with one overlay
BenchRow benchOverlay(
  const Setting& setting, const char* name, const std::vector<Overlay>& overlays)
{
  const BenchDome dome{ 100, 100.0_mm };
  const Mesh mesh = dome.mesh();
  const double outer = dome.radiusOf(500);
  vtkNew<vtkRenderer> renderer;
  PressView view(*renderer);
  view.setSurface(makePolyData(mesh.points, mesh.triangles));
  const Press middle = dome.press(outer, 0.0);
  view.setTip(middle.tip);
  view.setExtents(ExtentTable({ { 0.5 * middle.contact.depth, 0.5 * outer, 0.0, 0.0 },
    { middle.contact.depth, outer, 0.0, 0.0 } }));
  view.setVisible(overlays);
  view.lookAtSurface();
  const auto window = setting.context.makeWindow(160, 120);
  window->AddRenderer(renderer);
  const Frames frames = measure(setting.frames, *window,
    [&](int i)
    {
      const Press press = dome.press(outer, offsetOf(i, outer));
      Sample sample;
      sample.pose = press.pose;
      sample.contact = press.contact;
      sample.response.contactRadius = press.contactRadius;
      sample.response.force = 1.0;
      view.show(sample);
    });
  return benchRow("overlay", mesh.points.size(), name, frames.above);
}

} // namespace

std::vector<BenchRow> OffscreenRenderer::benchFrames(std::size_t most, int frames) const
{
  const Setting setting{ .context = {}, .frames = frames };
  std::vector<BenchRow> rows;
  for (const int n : { 40, 100, 316, 1000 })
  {
    const BenchDome dome{ n, 100.0_mm };
    for (const auto& [touched, mode] : { std::pair(500, "500"), std::pair(22'800, "22800") })
    {
      const auto count = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
      if (count <= most && (touched == 500 || n == 1000))
      {
        const auto two = benchSurface(setting, dome, touched, mode);
        rows.insert(rows.end(), two.begin(), two.end());
      }
    }
  }
  const std::vector<Overlay> usual(kUsualOverlays.begin(), kUsualOverlays.end());
  rows.push_back(benchOverlay(setting, "none", {}));
  rows.push_back(benchOverlay(setting, "arrow", { Overlay::ForceArrow }));
  rows.push_back(benchOverlay(setting, "circle", { Overlay::ContactCircle }));
  rows.push_back(benchOverlay(setting, "extent", { Overlay::ExtentCircle }));
  rows.push_back(benchOverlay(setting, "colors", { Overlay::DisplacementColors }));
  rows.push_back(benchOverlay(setting, "lines", { Overlay::IsoLines }));
  rows.push_back(benchOverlay(setting, "readings", { Overlay::Readings }));
  rows.push_back(benchOverlay(setting, "pressure", { Overlay::PressureColors }));
  rows.push_back(benchOverlay(setting, "net", { Overlay::ControlNet }));
  rows.push_back(benchOverlay(setting, "ghost", { Overlay::Ghost }));
  rows.push_back(benchOverlay(setting, "usual", usual));
  return rows;
}

} // namespace palp
