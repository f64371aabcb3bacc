#include "app/graphs/chart_theme.h"

#include "pipeline/charts/vtkPalpChart.h"
#include "pipeline/view/appearance.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotLine.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

using appearance::Color;

struct Inks
{
  Color ink;
  Color ground;
  Color grid;
};

constexpr Inks kLight{ appearance::kInk, appearance::kPaper, { 0.88, 0.89, 0.91 } };
constexpr Inks kDark{ { 0.88, 0.89, 0.91 }, { 0.13, 0.14, 0.16 }, { 0.25, 0.27, 0.29 } };

const Inks& inksOf(bool isDark)
{
  return isDark ? kDark : kLight;
}

} // namespace

void paintChart(vtkPalpChart& chart, bool isDark)
{
  const auto& [ink, ground, grid] = inksOf(isDark);
  chart.GetBackgroundBrush()->SetColorF(ground[0], ground[1], ground[2]);
  chart.GetTitleProperties()->SetColor(ink.data());
  for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    vtkAxis& axis = *chart.GetAxis(side);
    axis.GetTitleProperties()->SetColor(ink.data());
    axis.GetLabelProperties()->SetColor(ink.data());
    axis.GetPen()->SetColorF(ink[0], ink[1], ink[2]);
    axis.GetGridPen()->SetColorF(grid[0], grid[1], grid[2]);
  }
  for (vtkIdType i = 0; i < chart.GetNumberOfPlots(); ++i)
  {
    vtkPlot& plot = *chart.GetPlot(i);
    if (plot.GetLabel().empty() && !vtkPlotLine::SafeDownCast(&plot)) // marks, in ink
    {
      plot.SetColor(ink[0], ink[1], ink[2]);
    }
  }
}

void paintGround(vtkRenderWindow& window, bool isDark)
{
  vtkRendererCollection& all = *window.GetRenderers();
  all.InitTraversal();
  while (vtkRenderer* renderer = all.GetNextItem())
  {
    renderer->SetBackground(inksOf(isDark).ground.data());
  }
}

} // namespace palp
