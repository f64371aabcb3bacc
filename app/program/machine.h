#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace palp
{

/// The processor's name, or "unknown".
[[nodiscard]] std::string processorName();

namespace report
{

/// Where, with what and when: processor, cores, memory, system, compiler, version, date.
[[nodiscard]] nlohmann::ordered_json describeMachine();

} // namespace report
} // namespace palp
