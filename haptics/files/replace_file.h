#pragma once

#include "haptics/files/descriptor.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace palp
{

/// Whether a name is that of a hidden folder of makeHidden().
[[nodiscard]] bool isHidden(const std::string& name);

/// Makes a hidden folder in another one, with a name that nobody had.
/// @return  empty, with errno, where it cannot be made
[[nodiscard]] std::filesystem::path makeHidden(const std::filesystem::path& folder);

/// Locks a folder as long as what is returned lives, and its process.
/// @return  none where another has it, or it cannot be opened
[[nodiscard]] Descriptor tryLockFolder(const std::filesystem::path& folder);

/// Brings the content of a file, or the names of a folder, to the disk.
/// @return  0, or errno
int syncToDisk(const std::filesystem::path& path);

/// The name of a file as it will be, without the hidden folders that it waits in.
[[nodiscard]] std::string shownName(const std::filesystem::path& file);

/// Ends the writing of a file with what the system said.
/// @param reason  errno
/// @throws Error  BadFile
[[noreturn]] void refuseFile(const std::filesystem::path& file, int reason);

/// Replaces a file as a whole: written beside it, on the disk, then renamed. A link of that name is
/// replaced, not followed. What killed processes left there goes first, see clearStages().
/// @throws Error  BadFile: cannot be written; the file before remains, and nothing beside it
void replaceFile(const std::filesystem::path& file, std::string_view content);

/// The same for what writes itself into the file that it is given.
void replaceFile(const std::filesystem::path& file,
  const std::function<void(const std::filesystem::path& fresh)>& write);

} // namespace palp
