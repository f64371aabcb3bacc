#pragma once

#include "app/input/scene_plan.h"
#include "app/plots/press_plots.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace palp
{

/// How charts are laid out for print, whatever size they have on the screen: letters and lines grow
/// with the size.
struct ChartSheet
{
  ImageSize size{};     ///< in pixels, of lines and text in points
  int dpi = 0;          ///< of its letters
  std::string ending{}; ///< of the file: .png, .svg, .pdf

  /// The size of a sheet if nobody wishes another.
  [[nodiscard]] static ImageSize usualSize(const Plots& plots);

  /// @param size     none: the usual one
  /// @throws Error   BadFile: another ending
  [[nodiscard]] static ChartSheet of(
    const Plots& plots, const std::filesystem::path& file, std::optional<ImageSize> size);
};

/// Charts that another program on this machine draws.
struct ChartJob
{
  ChartSheet sheet{};
  Plots plots{};
};

/// The file of one within a folder, and what comes of it, which has the ending of the sheet.
inline constexpr const char* kChartJob = "charts.job";
inline constexpr const char* kChartsMade = "charts";

/// @param plots  with linear axes and their legend
[[nodiscard]] std::string pack(const ChartSheet& sheet, const Plots& plots);

/// @param bytes  of pack, in a program of the same build
/// @return       nothing where they are not
[[nodiscard]] std::optional<ChartJob> unpackChartJob(std::string_view bytes);

} // namespace palp
