#include "app/plots/chart_job.h"

#include "haptics/error.h"
#include "pipeline/process/packed_values.h"
#include "pipeline/view/appearance.h"

#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>
#include <vtkAxis.h>
#include <vtkDoubleArray.h>

namespace palp
{
namespace
{

constexpr std::array kSides{ vtkAxis::BOTTOM, vtkAxis::LEFT };

void packText(std::string& bytes, const std::string& text)
{
  packValues(bytes, text);
}

bool unpackText(std::string_view& bytes, std::string& text)
{
  return unpackValues(bytes, text);
}

void packCurve(std::string& bytes, const Plot::Curve& curve, vtkTable& table)
{
  packOne(bytes, curve.kind);
  packOne(bytes, curve.color);
  packOne(bytes, curve.size);
  packOne(bytes, curve.style);
  packText(bytes, curve.name);
  packOne(bytes, static_cast<std::size_t>(table.GetNumberOfColumns()));
  for (vtkIdType i = 0; i < table.GetNumberOfColumns(); ++i)
  {
    auto& column = *vtkDoubleArray::SafeDownCast(table.GetColumn(i));
    const auto count = static_cast<std::size_t>(column.GetNumberOfValues());
    packValues(bytes, std::span(column.GetPointer(0), count));
  }
}

bool unpackCurve(std::string_view& bytes, Plot& plot)
{
  Plot::Curve curve;
  std::vector<std::vector<double>> columns;
  const bool read = unpackOne(bytes, curve.kind) && unpackOne(bytes, curve.color) &&
    unpackOne(bytes, curve.size) && unpackOne(bytes, curve.style) &&
    unpackText(bytes, curve.name) &&
    unpackEach(bytes, columns,
      [](std::string_view& rest, std::vector<double>& column)
      { return unpackValues(rest, column); });
  if (read && columns.size() > 1)
  {
    plot.add(curve, columns[0], columns[1], columns.size() > 2 ? columns[2] : std::span<double>());
  }
  return read && columns.size() > 1;
}

// which axes are held, and which curves are hidden
void packView(std::string& bytes, vtkPalpChart& chart, const std::vector<Plot::Curve>& curves)
{
  for (const int side : kSides)
  {
    packOne(bytes, chart.IsHeld(side));
    packOne(bytes, chart.GetAxis(side)->GetMinimum());
    packOne(bytes, chart.GetAxis(side)->GetMaximum());
  }
  std::vector<std::string> hidden;
  for (const Plot::Curve& curve : curves)
  {
    chart.IsCurveShown(curve.name) ? void() : hidden.push_back(curve.name);
  }
  packEach(bytes, hidden, packText);
}

bool unpackView(std::string_view& bytes, vtkPalpChart& chart)
{
  for (const int side : kSides)
  {
    bool isHeld = false;
    double least = 0.0;
    double most = 0.0;
    if (!unpackOne(bytes, isHeld) || !unpackOne(bytes, least) || !unpackOne(bytes, most))
    {
      return false;
    }
    isHeld ? chart.Hold(side, least, most) : void();
  }
  std::vector<std::string> hidden;
  const bool read = unpackEach(bytes, hidden, unpackText);
  for (const std::string& name : hidden)
  {
    chart.SetCurveShown(name, false);
  }
  return read;
}

void packPlot(std::string& bytes, Plot& plot)
{
  packText(bytes, plot.chart().GetTitle());
  for (const int side : kSides)
  {
    packText(bytes, plot.chart().GetAxis(side)->GetTitle());
  }
  const std::vector<Plot::Curve>& curves = plot.curves();
  packOne(bytes, curves.size());
  for (std::size_t i = 0; i < curves.size(); ++i)
  {
    packCurve(bytes, curves[i], *plot.tables()[i]);
  }
  packView(bytes, plot.chart(), curves);
}

bool unpackPlot(std::string_view& bytes, std::unique_ptr<Plot>& plot)
{
  std::string title;
  std::string bottom;
  std::string left;
  std::size_t count = 0;
  bool read = unpackText(bytes, title) && unpackText(bytes, bottom) && unpackText(bytes, left) &&
    unpackOne(bytes, count);
  plot = std::make_unique<Plot>(title, bottom, left);
  while (read && count-- > 0)
  {
    read = unpackCurve(bytes, *plot);
  }
  return read && unpackView(bytes, plot->chart());
}

} // namespace

ImageSize ChartSheet::usualSize(const Plots& plots)
{
  return { .width = 1600, .height = plots.size() > 1 ? 1500 : 1000 };
}

ChartSheet ChartSheet::of(
  const Plots& plots, const std::filesystem::path& file, std::optional<ImageSize> wanted)
{
  constexpr double kUsualGrowth = 2.0; // letters and marks twice as large as on a screen
  const std::string ending = file.extension().string();
  if (ending != ".png" && ending != ".svg" && ending != ".pdf")
  {
    throw Error(ErrorCode::BadFile, file.string() + ": end the name in .png, .svg, .pdf or .csv");
  }
  const ImageSize usual = usualSize(plots);
  const ImageSize size = wanted.value_or(usual);
  constexpr double kLeastShare = 0.4; // of the height for a second chart, and so on
  constexpr ImageSize kLeast{ .width = 200, .height = 150 };
  const double least =
    kLeast.height / std::pow(kLeastShare, static_cast<double>(plots.size()) - 1.0);
  if (size.width < kLeast.width || size.height < least)
  {
    throw Error(ErrorCode::BadValue,
      "size: " + std::to_string(size.width) + "x" + std::to_string(size.height) +
        " has no room for axes; give " + std::to_string(kLeast.width) + "x" +
        std::to_string(std::lround(least)) + " or more");
  }
  const double area = static_cast<double>(size.width) * size.height / usual.width / usual.height;
  const double growth = std::max(1.0, kUsualGrowth * std::sqrt(area));
  const double divisor = ending == ".png" ? 1.0 : growth; // lines are as sharp at any size
  const auto rounded = [](double value) { return static_cast<int>(std::lround(value)); };
  return { .size = { .width = rounded(size.width / divisor),
             .height = rounded(size.height / divisor) },
    .dpi = rounded(appearance::kDpi * growth / divisor),
    .ending = ending };
}

std::string pack(const ChartSheet& sheet, const Plots& plots)
{
  std::string bytes;
  packOne(bytes, sheet.size);
  packOne(bytes, sheet.dpi);
  packText(bytes, sheet.ending);
  packEach(
    bytes, plots, [](std::string& to, const std::unique_ptr<Plot>& plot) { packPlot(to, *plot); });
  return bytes;
}

std::optional<ChartJob> unpackChartJob(std::string_view bytes)
{
  ChartJob job;
  const bool read = unpackOne(bytes, job.sheet.size) && unpackOne(bytes, job.sheet.dpi) &&
    unpackText(bytes, job.sheet.ending) && unpackEach(bytes, job.plots, unpackPlot) &&
    bytes.empty();
  return read ? std::optional(std::move(job)) : std::nullopt;
}

} // namespace palp
