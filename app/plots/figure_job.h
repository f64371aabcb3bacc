#pragma once

#include "app/plots/press_figure.h"
#include "pipeline/model/surface_map.h"

#include <optional>
#include <string>
#include <string_view>

namespace palp
{

/// A figure that another program on this machine draws, of a press whose body, tool and tissue are
/// those of an export folder.
struct FigureJob
{
  ImageSize size{};
  FigureLook look{};
  CameraPlace camera{};
  Sample sample{};
  std::optional<SurfaceMap> map{}; ///< colors of the body; none: its own
};

/// The files of one within such a folder: what is asked for, and what comes of it.
inline constexpr const char* kFigureJob = "figure.job";
inline constexpr const char* kFigureMade = "figure.png";

[[nodiscard]] std::string pack(const FigureJob& job);

/// @param bytes  of pack, in a program of the same build
/// @return       nothing where they are not
[[nodiscard]] std::optional<FigureJob> unpackFigureJob(std::string_view bytes);

} // namespace palp
