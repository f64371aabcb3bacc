#include "pipeline/charts/figure_plot.h"

#include "calibration/figures/palette.h"

#include <algorithm>
#include <string>
#include <vector>

namespace palp
{
namespace
{

using figures::Curve;

// of #rrggbb
appearance::Color colorOf(const char* hex)
{
  const auto digits = std::stoul(hex + 1, nullptr, 16);
  const auto part = [&](unsigned shift)
  { return static_cast<double>((digits >> shift) & 0xffU) / 255.0; };
  return { part(16), part(8), part(0) };
}

void addCurve(Plot& plot, const Curve& curve, const figures::Points& points)
{
  const bool isShade = curve.style == Curve::Style::Cells;
  const appearance::Color color =
    colorOf(isShade ? figures::shadeColor(curve.color) : figures::paletteColor(curve.color));
  const auto mark = [&](Plot::Mark shape, float size)
  { plot.addPoints(curve.label, points.x, points.y, color, shape, size); };
  switch (curve.style)
  {
    case Curve::Style::Line:
    case Curve::Style::Dashed:
      if (points.x.size() == 1) // is no line
      {
        mark(Plot::Mark::Circle, 8.0F);
      }
      else if (!points.x.empty())
      {
        plot.addLine(curve.label, points.x, points.y, color, 2.0F,
          curve.style == Curve::Style::Dashed ? appearance::LineStyle::Dashed
                                              : appearance::LineStyle::Solid);
      }
      break;
    case Curve::Style::Circles:
      mark(Plot::Mark::Circle, 8.0F);
      break;
    case Curve::Style::Squares:
      mark(Plot::Mark::Square, 7.0F);
      break;
    case Curve::Style::Diamonds:
      mark(Plot::Mark::Diamond, 10.0F);
      break;
    case Curve::Style::Cells:
      mark(Plot::Mark::Square, 12.0F);
      break;
  }
}

} // namespace

std::unique_ptr<Plot> figurePlot(
  const figures::Figure& figure, std::span<const figures::Table> tables, figures::Layout layout)
{
  const bool alone = layout == figures::Layout::Alone;
  auto plot = std::make_unique<Plot>(alone ? figure.caption : "", figure.bottom, figure.left);
  if (figure.band > 0.0 && !figure.curves.empty())
  {
    const std::vector<double> x = figures::pointsOf(tables, figure.curves.front()).x;
    plot->addBand(figures::bandLabel(figure), x, std::vector(x.size(), -figure.band),
      std::vector(x.size(), figure.band), colorOf(figures::kBandColor));
  }
  for (const Curve& curve : figure.curves)
  {
    addCurve(*plot, curve, figures::pointsOf(tables, curve));
  }
  if (std::ranges::any_of(
        figure.curves, [](const Curve& curve) { return curve.style == Curve::Style::Cells; }))
  {
    plot->keepMarksWhole();
  }
  plot->setLogarithmic(figure.logBottom, figure.logLeft);
  if (!alone)
  {
    plot->hideLegend();
  }
  return plot;
}

} // namespace palp
