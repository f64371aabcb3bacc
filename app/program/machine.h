#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace palp
{

/// The processor's name, or "unknown".
[[nodiscard]] std::string processorName();

/// Blocks of a megabyte and more, as the samples of a press, go back to the system once freed: what
/// is left of them between others would add up while presses go on for hours.
void giveBackLargeBlocks() noexcept;

namespace report
{

/// Where, with what and when: processor, cores, memory, system, compiler, version, date.
[[nodiscard]] nlohmann::ordered_json describeMachine();

} // namespace report
} // namespace palp
