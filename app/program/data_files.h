#pragma once

#include <filesystem>

namespace palp
{

/// A file that is shipped with the program: meshes/, paths/, tables/ and reference/.
///
/// Found beside the program, in ../share/palp, both where it is built and where it is installed;
/// the environment variable PALP_DATA names another place.
///
/// @throws Error  BadFile: not there
[[nodiscard]] std::filesystem::path dataFile(const std::filesystem::path& name);

} // namespace palp
