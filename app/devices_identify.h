#pragma once

#include <string>

namespace palp
{

/// Measures an arm, says what was found and why it matters, and keeps it for this user.
///
/// @param name    as a user names a device
/// @param added   a mass on its handle, as 100g; empty: none
/// @return        exit code: 0, or 6 where its motion does not follow its motors
/// @throws Error  as openDriver, identifyArm, saveArm; BadValue: the mass
[[nodiscard]] int identifyDevice(const std::string& name, const std::string& added);

/// Lets a PHD1 board move to its zero.
/// @return        exit code: 0, or 6 where it did not get there in ten seconds
/// @throws Error  as openDriver; BadValue: another device
[[nodiscard]] int homeDevice(const std::string& name);

} // namespace palp
