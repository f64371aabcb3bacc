#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace palp
{

/// All of a text that somebody names, without a byte order mark: a file, or a pipe.
///
/// @param what    it should be, for the message: "a CSV file"
/// @throws Error  BadFile: missing, not permitted, a folder or a device, larger than 512 MB, or a
///                pipe into which nothing is written for 5 s
[[nodiscard]] std::string readText(const std::filesystem::path& file, const std::string& what);

/// The first 200 bytes of a text for a message, printable, and dots where it goes on.
[[nodiscard]] std::string shortened(const std::string& text);

/// A piece of such a text for a message: in single quotes, cut to 40 bytes,
/// without control characters.
[[nodiscard]] std::string inQuotes(std::string_view text);

/// The same text without control characters, which a terminal would obey.
[[nodiscard]] std::string printable(std::string text);

/// A number with what it counts: 1 case, 2 cases.
/// @param many  of a word whose plural has not just an s
[[nodiscard]] std::string counted(
  std::size_t number, const std::string& one, const std::string& many = "");

/// A text without the blanks before and after it: spaces, tabs, carriage returns.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// With a to z for A to Z.
[[nodiscard]] std::string lowered(std::string text);

/// The parts of a text between separators; one more than there are of them.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

} // namespace palp
