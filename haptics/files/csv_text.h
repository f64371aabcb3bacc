#pragma once

#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palp
{

/// The shortest text that reads back as the same double; C locale. `inf` and `nan` as such.
[[nodiscard]] std::string shortest(double value);

/// Writes one line of comma-separated numbers, shortest digits.
void writeCsvRow(std::ostream& out, std::span<const double> values);

/// A word as RFC 4180 has it: in quotes where it holds a comma, a quote or a line break.
[[nodiscard]] std::string csvField(const std::string& text);

/// The words of one line, without their quotes.
[[nodiscard]] std::vector<std::string> csvFields(std::string_view line);

/// The number that a cell is, blanks around it aside, with or without a plus; C locale, `inf` and
/// `nan` among them. None: it is something else.
[[nodiscard]] std::optional<double> csvNumber(std::string_view cell) noexcept;

} // namespace palp
