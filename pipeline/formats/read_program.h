#pragma once

#include "pipeline/formats/surface_formats.h"

namespace palp
{

/// Main function of palp-read, which see: reads what the arguments name, for the program that
/// started it. Readers of other people's files may crash or run away, and here they do it alone.
///
/// @param dicom  readers of DICOM; without them such a file is refused
[[noreturn]] void readForAnother(int argc, char** argv, const DicomReaders& dicom);

} // namespace palp
