#pragma once

#include <cstdint>
#include <string>

namespace palp
{

/// Parts of a TrainingPlan as text, for options, scenes and window alike.
/// @throws Error  BadValue: names the option, what is wrong and how to write it
[[nodiscard]] std::uint32_t parseSeed(const std::string& text, const std::string& what = "--seed");
[[nodiscard]] int parseNoduleCount(
  const std::string& text, const std::string& what = "--nodules"); ///< 1 to 12

} // namespace palp
