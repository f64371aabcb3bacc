#pragma once

#include "haptics/error.h"

#include <filesystem>
#include <string>

namespace palp
{

/// @throws Error  BadFile: the file, and what is wrong with it
[[noreturn]] inline void refuse(const std::filesystem::path& file, const std::string& message)
{
  throw Error(ErrorCode::BadFile, file.string() + ": " + message);
}

} // namespace palp
