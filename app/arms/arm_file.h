#pragma once

#include "haptics/devices/arm.h"

#include <filesystem>
#include <optional>
#include <string>

namespace palp
{

/// Where what was measured of a device is kept: arms/IDENTITY.json of palp in XDG_CONFIG_HOME, or
/// in
/// ~/.config.
/// @param identity  as identityOf; what is neither letter, digit, dot nor dash becomes a dash
[[nodiscard]] std::filesystem::path armFile(const std::string& identity);

/// @throws Error  BadFile: it cannot be written
void saveArm(const std::filesystem::path& file, const IdentifiedArm& arm);

/// What is kept there; nothing where there is no such file.
/// @throws Error  BadFile: file, key, what is wrong with it, and to identify the device again
[[nodiscard]] std::optional<IdentifiedArm> loadArm(const std::filesystem::path& file);

} // namespace palp
