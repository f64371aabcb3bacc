#pragma once

#include "app/report/document.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace palp::report
{

/// Writes report.html: one file with its figures inside, and links to the data beside it.
///
/// @param folder   holds an SVG for each figure, which are taken in
/// @param unfinished  titles of parts that are missing
/// @throws Error   BadFile: a figure is missing, or the page cannot be written
void writePage(const std::filesystem::path& folder, const nlohmann::ordered_json& machine,
  const std::vector<Section>& sections, const std::vector<std::string>& unfinished);

} // namespace palp::report
