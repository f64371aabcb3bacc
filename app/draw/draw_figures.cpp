#include "app/draw/offscreen.h"
#include "app/draw/offscreen_renderer.h"
#include "pipeline/charts/figure_plot.h"
#include "pipeline/charts/plot_files.h"

#include <vtkContextView.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

constexpr ImageSize kAlone{ .width = 1000, .height = 600 };
constexpr ImageSize kOnPage{ .width = 720, .height = 430 };
constexpr ImageSize kOfGroup{ .width = 420, .height = 340 };

} // namespace

void OffscreenRenderer::drawFigures(std::span<const figures::Figure> figures,
  std::span<const figures::Table> tables, figures::Layout layout,
  const std::filesystem::path& directory) const
{
  if (figures.empty())
  {
    return;
  }
  const bool alone = layout == figures::Layout::Alone;
  const OffscreenContext context;
  for (const figures::Figure& figure : figures)
  {
    const auto [width, height] = alone ? kAlone : figure.group.empty() ? kOnPage : kOfGroup;
    const auto window = context.makeWindow(width, height);
    vtkNew<vtkContextView> view;
    view->SetRenderWindow(window);
    view->GetRenderer()->SetBackground(1.0, 1.0, 1.0);
    const auto plot = figurePlot(figure, tables, layout);
    plot->addTo(*view->GetScene());
    alone ? writePng(*window, directory / (figure.name + ".png"))
          : writeSvg(*window, directory / (figure.name + ".svg"));
  }
}

} // namespace palp
