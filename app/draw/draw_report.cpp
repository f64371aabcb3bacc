#include "app/draw/offscreen.h"
#include "app/draw/offscreen_renderer.h"
#include "app/report/html_page.h"
#include "pipeline/charts/plot_files.h"

#include <vtkContextView.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <string>

namespace palp
{
namespace
{

constexpr ImageSize kAlone{ .width = 720, .height = 430 };
constexpr ImageSize kOfGroup{ .width = 420, .height = 340 };

appearance::Color colorOf(const report::Curve& curve)
{
  const auto digits = std::stoul(report::paletteColor(curve.color) + 1, nullptr, 16);
  const auto part = [&](unsigned shift)
  { return static_cast<double>((digits >> shift) & 0xffU) / 255.0; };
  return { part(16), part(8), part(0) };
}

void addCurve(Plot& plot, const report::Section& section, const report::Curve& curve)
{
  const report::Points points = report::pointsOf(section, curve);
  const appearance::Color color = colorOf(curve);
  switch (curve.style)
  {
    case report::Curve::Style::Line:
    case report::Curve::Style::Dashed:
      if (points.x.size() > 1)
      {
        plot.addLine(curve.label, points.x, points.y, color, 2.0F,
          curve.style == report::Curve::Style::Dashed);
      }
      break;
    case report::Curve::Style::Circles:
      plot.addPoints(curve.label, points.x, points.y, color, Plot::Mark::Circle, 8.0F);
      break;
    case report::Curve::Style::Squares:
      plot.addPoints(curve.label, points.x, points.y, color, Plot::Mark::Square, 7.0F);
      break;
    case report::Curve::Style::Diamonds:
      plot.addPoints(curve.label, points.x, points.y, color, Plot::Mark::Diamond, 10.0F);
      break;
  }
}

} // namespace

void OffscreenRenderer::drawReport(
  const report::Section& section, const std::filesystem::path& directory) const
{
  if (section.charts.empty())
  {
    return;
  }
  const OffscreenContext context;
  for (const report::Chart& chart : section.charts)
  {
    Plot plot("", chart.bottom, chart.left);
    for (const report::Curve& curve : chart.curves)
    {
      addCurve(plot, section, curve);
    }
    plot.setLogarithmic(chart.logBottom, chart.logLeft);
    plot.hideLegend(); // the page has one, in its own type
    const auto [width, height] = chart.group.empty() ? kAlone : kOfGroup;
    const auto window = context.makeWindow(width, height);
    vtkNew<vtkContextView> view;
    view->SetRenderWindow(window);
    view->GetRenderer()->SetBackground(1.0, 1.0, 1.0);
    plot.addTo(*view->GetScene());
    writeSvg(*window, directory / (chart.name + ".svg"));
  }
}

} // namespace palp
