#pragma once

#include "pipeline/process/file_surface.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace palp
{

/// Reads the names of labels: a color table of 3D Slicer (`5 liver 221 130 101 255`, or CSV whose
/// first line names the columns `LabelValue`, `Name`, `Color_R`, `Color_G`, `Color_B`), labels of
/// ITK-SNAP (`5 221 130 101 1 1 1 "liver"`), or JSON as TotalSegmentator has it, either way round
/// (`{"5": "liver"}` or `{"liver": 5}`).
///
/// @throws Error  BadFile: cannot be read, or what is wrong in which line
[[nodiscard]] std::vector<LabelName> readLabelNames(const std::filesystem::path& file);

/// Colors of labels, as "#dd8265", by their values; of JSON none.
/// @throws Error  as readLabelNames
[[nodiscard]] std::map<double, std::string> readLabelColors(const std::filesystem::path& file);

/// The labels, names of the table as their values; others stay, for the image may name them.
/// @throws Error  BadValue: a name of several values
[[nodiscard]] std::vector<std::string> valuesOfLabels(
  std::vector<std::string> labels, std::span<const LabelName> names);

} // namespace palp
