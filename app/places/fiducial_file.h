#pragma once

#include "app/input/press_places.h"

#include <filesystem>
#include <vector>

namespace palp
{

/// A list of points.
struct Fiducials
{
  std::vector<PressPlace> places;
  std::size_t unplaced = 0; ///< points that the list names and nobody placed; left out
};

/// The points of a list of 3D Slicer, in its order, in LPS: the axes in which 3D Slicer saves its
/// models and Palp reads images. A list in RAS, by its header, has x and y turned round. The labels
/// become names.
///
/// @param file    .fcsv or .mrk.json
/// @throws Error  BadFile: unreadable, another ending, no point, no axes stated or others than LPS
///                and RAS, not millimeters; names the line or the key
[[nodiscard]] Fiducials readFiducials(const std::filesystem::path& file);

} // namespace palp
