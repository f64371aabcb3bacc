#pragma once

#include "haptics/stability/stability_case.h"

#include <vector>

namespace palp
{

/// Arms, buses and hands that press and draw along tissue with a memory: relaxation, friction and
/// nodules, each of none to more than any organ has. A Latin hypercube, always the same.
///
/// @param count  how many
[[nodiscard]] std::vector<StabilityCase> tissueCases(int count);

} // namespace palp
