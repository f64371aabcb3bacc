#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace palp
{

/// "2/4" as the cases 1, 5, 9, ...
/// @throws Error  BadValue: no part of a whole
[[nodiscard]] std::vector<std::size_t> shardOf(const std::string& text, std::size_t count);

/// A whole number from 0 to count - 1.
/// @param what    the option, or another that says it
/// @param thing   that is counted
/// @throws Error  BadValue: none
[[nodiscard]] std::size_t numberBelow(const std::string& text, std::size_t count,
  const std::string& what, const std::string& thing = "case");

} // namespace palp
