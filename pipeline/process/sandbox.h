#pragma once

#include <filesystem>
#include <vector>

namespace palp
{

/// Gives up, for good and for all threads, whatever reading a file does not need.
///
/// From then on this process opens nothing but what is listed, for reading; writes to one
/// descriptor; starts no process, connects to nothing and gains no privileges. By Landlock and
/// seccomp; what the kernel lacks of them is left out. It must have one thread.
///
/// @param output    the descriptor that stays writable
/// @param readable  files, or folders with all that is in them
void enterSandbox(int output, const std::vector<std::filesystem::path>& readable) noexcept;

} // namespace palp
