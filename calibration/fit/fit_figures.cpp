#include "calibration/fit/fit_figures.h"

#include "haptics/units.h"

namespace palp::fit
{
namespace
{

using figures::Curve;
using figures::Figure;

constexpr const char* kTable = "fit";
constexpr int kColors = 7;           // of the palette, without its gray
constexpr std::size_t kInLegend = 7; // of more curves none is named

Curve column(const FittedCurve& curve, const char* title, Curve::Style style, int color)
{
  return { .label = "",
    .table = kTable,
    .x = "depth_mm",
    .y = title,
    .where = { { "curve", curve.name } },
    .style = style,
    .color = color };
}

} // namespace

figures::Table fitTable(std::span<const FittedCurve> curves)
{
  figures::Table table{ .name = kTable,
    .caption = "Measured and fitted force",
    .columns = { "curve", "depth_mm", "force_N", "fitted_N", "residual_N" } };
  for (const FittedCurve& curve : curves)
  {
    const Eigen::VectorXd& forces = curve.fit.asked().curve.forces;
    for (Eigen::Index i = 0; i < forces.size(); ++i)
    {
      const double measured = curve.loading.forces[i];
      table.rows.push_back({ curve.name, units::toMillimeters(curve.loading.depths[i]), measured,
        forces[i], measured - forces[i] });
    }
  }
  return table;
}

std::vector<Figure> fitFigures(std::span<const FittedCurve> curves)
{
  Figure fit{ .name = kTable,
    .caption = "Measured and fitted force",
    .bottom = "depth [mm]",
    .left = "force [N]" };
  Figure residuals{ .name = "residuals",
    .caption = "Measured less fitted force",
    .bottom = fit.bottom,
    .left = "residual [N]" };
  for (std::size_t i = 0; i < curves.size(); ++i)
  {
    const int color = static_cast<int>(i) % kColors;
    fit.curves.push_back(column(curves[i], "force_N", Curve::Style::Circles, color));
    fit.curves.push_back(column(curves[i], "fitted_N", Curve::Style::Line, color));
    residuals.curves.push_back(column(curves[i], "residual_N", Curve::Style::Circles, color));
    if (curves.size() <= kInLegend)
    {
      fit.curves[2 * i].label = curves[i].name;
      fit.curves[2 * i + 1].label = curves[i].fit.asked().name + " law";
      residuals.curves[i].label = curves[i].name;
    }
  }
  return { fit, residuals };
}

} // namespace palp::fit
