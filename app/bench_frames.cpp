#include "app/bench_dome.h"
#include "app/draw_pictures.h"
#include "app/offscreen.h"
#include "haptics/units.h"
#include "pipeline/poly_data.h"
#include "pipeline/vtkPalpDeformFilter.h"
#include "pipeline/vtkPalpPatchMapper.h"

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

constexpr int kFrames = 200;
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
    constexpr std::size_t kMost = 3 * 10'000;
    std::size_t& count = Primitives[PrimitiveTris].IBO->IndexCount;
    const std::size_t all = count;
    count = std::min(count, kMost);
    vtkPalpPatchMapper::RenderPieceDraw(renderer, actor);
    count = all;
  }
};
vtkStandardNewMacro(SomeTriangles);

// a picture drawn again, and how much longer one with a moved dent takes
std::vector<BenchRow> benchSurface(
  const OffscreenContext& context, const BenchDome& dome, double touched, const char* mode)
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
  const auto window = context.makeWindow(160, 120);
  window->AddRenderer(renderer);
  const auto draw = [&](int)
  {
    window->Render();
    glFinish();
  };
  const auto move = [&](int i)
  {
    press->SetPress(dome.press(outer, 0.05 * outer * (i % kSteps - kSteps / 2)));
    draw(i);
  };
  for (int i = 0; i < kSteps; ++i)
  {
    move(i);
  }
  // in turns, for other work on the machine comes and goes
  std::vector<double> still;
  const auto redraw = [&](int i)
  {
    const auto begin = std::chrono::steady_clock::now();
    draw(i);
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
    still.push_back(time.count());
  };
  std::vector<double> above = timed(kFrames, redraw, move);
  std::transform(above.begin(), above.end(), still.begin(), above.begin(), std::minus<>());
  return { benchRow("frame", mesh.points.size(), "still", still),
    benchRow("frame", mesh.points.size(), mode, above) };
}

} // namespace

std::vector<BenchRow> DrawPictures::benchFrames(std::size_t most) const
{
  const OffscreenContext context;
  std::vector<BenchRow> rows;
  for (const int n : { 40, 100, 316, 1000 })
  {
    const BenchDome dome{ n, 100.0_mm };
    for (const auto& [touched, mode] : { std::pair(500, "500"), std::pair(22'800, "22800") })
    {
      const auto count = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
      if (count <= most && (touched == 500 || n == 1000))
      {
        const auto two = benchSurface(context, dome, touched, mode);
        rows.insert(rows.end(), two.begin(), two.end());
      }
    }
  }
  return rows;
}

} // namespace palp
