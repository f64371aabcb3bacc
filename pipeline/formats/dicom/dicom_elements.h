#pragma once

#include <filesystem>

namespace palp
{

/// Follows a file of DICOM from element to element by the lengths that it claims, before GDCM does,
/// which takes room for what they claim and ends the process at what it does not expect. Not in a
/// deflated file, nor in private sequences of known length, which some scanners write otherwise.
///
/// @return        whether it is of DICOM
/// @throws Error  BadFile: cut off or damaged; the element at which that shows
/// @source        DICOM PS3.5, 7; PS3.10, 7.1
[[nodiscard]] bool checkElements(const std::filesystem::path& file);

} // namespace palp
