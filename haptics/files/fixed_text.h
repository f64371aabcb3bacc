#pragma once

#include <string>

namespace palp
{

/// A number for people, with as many digits behind the point; 0 has no sign, however small what was
/// rounded to it.
[[nodiscard]] std::string fixed(double value, int digits);

} // namespace palp
