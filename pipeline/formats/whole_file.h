#pragma once

#include <filesystem>

namespace palp
{

// What tells that a file was cut off, before a reader of VTK meets its end in words of its own or
// crashes.

/// @throws Error  BadFile: an XML file of VTK without its last tag
void checkXmlEnd(const std::filesystem::path& file);

} // namespace palp
