#pragma once

#include "haptics/servo/sample.h"

#include <string>

namespace palp
{

/// What a device is doing, for people: "force on", "needs homing", ...
[[nodiscard]] const char* describe(DeviceState state) noexcept;

/// What the user can do so that a force comes, or comes back; empty when nothing has to be done.
[[nodiscard]] const char* advise(DeviceState state, std::uint32_t flags) noexcept;

/// What acts on the force of a sample, for people; empty when nothing does.
[[nodiscard]] std::string describeFlags(std::uint32_t flags);

} // namespace palp
