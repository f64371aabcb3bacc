#pragma once

#include "app/sweep/case_inputs.h"

#include <string>
#include <vector>

namespace palp
{

/// What a sweep may set of a command: all that changes the numbers; not where they go or how they
/// are drawn.
/// @param kind  calibrate, force or run
[[nodiscard]] CommandOptions caseOptions(const std::string& kind);

/// Whether a command would take the words of a case, without running it.
/// @param words   the command first
/// @throws Error  in one sentence what it refuses
void checkCase(const std::vector<std::string>& words);

} // namespace palp
