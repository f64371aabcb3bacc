#pragma once

#include <iosfwd>
#include <span>
#include <string>

namespace palp
{

/// The shortest text that reads back as the same double; C locale. `inf` and `nan` as such.
[[nodiscard]] std::string shortest(double value);

/// Writes one line of comma-separated numbers, shortest digits.
void writeCsvRow(std::ostream& out, std::span<const double> values);

} // namespace palp
