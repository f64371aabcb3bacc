#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>

namespace palp
{

/// The shortest text that reads back as the same double; C locale. `inf` and `nan` as such.
[[nodiscard]] std::string shortest(double value);

/// Writes one line of comma-separated numbers, shortest digits.
void writeCsvRow(std::ostream& out, std::span<const double> values);

/// Replaces a file as a whole, so that an interruption leaves the one before.
/// @return  false where it cannot be written; the file before remains, and nothing beside it
[[nodiscard]] bool replaceFile(const std::filesystem::path& file, const std::string& content);

} // namespace palp
