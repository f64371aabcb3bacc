#pragma once

#include "haptics/tip/tip.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace palp
{

/// Reads a tool, as in `sphere:10mm` or `cone:45deg:10mm`.
///
/// sphere:R, cone:ALPHA:BASE, punch:R, truncated-cone:ALPHA:FLAT:BASE, blunt-cone:ALPHA:TIP:BASE,
/// paraboloid:R, profile:FILE. Radii with unit; ALPHA between axis and flank.
///
/// @throws Error  BadValue: unknown kind, wrong number of parts, a dimension out of range
[[nodiscard]] Tip parseTip(std::string_view text);

/// The same text back, which reads as the same tool to the last bit; a profile by its file's name
/// alone.
[[nodiscard]] std::string describeTip(const Tip& tip);

/// The file of a profile; empty for other tools.
[[nodiscard]] std::filesystem::path fileOf(const Tip& tip);

} // namespace palp
