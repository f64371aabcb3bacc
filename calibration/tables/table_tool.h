#pragma once

#include "haptics/tip/tip.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace palp
{

// the tool that a table of finite elements was computed for, as its header tells it

inline constexpr std::string_view kToolLine = "# tool: "; ///< how its line begins

/// @param digits  of its numbers; a table has the default
[[nodiscard]] std::string toolInWords(const Tip& tip, int digits = 6);

/// What the header of a table says; empty: nothing.
/// @throws Error  BadFile: cannot be read
[[nodiscard]] std::string toolOfTable(const std::filesystem::path& file);

/// Whether it says this tool; a sharp cone stands for one with a small cap.
[[nodiscard]] bool isToolOfTable(const Tip& tip, const std::string& inTable);

} // namespace palp
