#pragma once

#include <filesystem>

namespace palp
{

struct ExportFolder;

/// Tells on standard error how what was made anew from an exported folder differs from what that
/// says of its files, and from what these are now. Keeps what cannot be repeated.
/// @param out  what was made anew
void tellRepetition(const ExportFolder& repeated, const std::filesystem::path& out);

} // namespace palp
