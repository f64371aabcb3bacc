#pragma once

#include "haptics/devices/arm.h"

#include <string>

namespace palp
{

/// Why a measured arm cannot be: one axis is more than six times as heavy as the others, or as
/// light. Empty: it can.
[[nodiscard]] std::string unlikeAxis(const IdentifiedArm& arm);

} // namespace palp
