#pragma once

#include "pipeline/formats/joined_corners.h"
#include "pipeline/formats/surface_formats.h"
#include "pipeline/surface_io/surface_io.h"

namespace palp::test
{

/// Reads many files, every fifth as the program does; the others in the process of the test, where
/// a sanitizer tells more of a crash, and without a start of palp-read for each.
class ManyReader
{
public:
  LoadedSurface read(const std::filesystem::path& file, UnitChoice unit = {})
  {
    return count_++ % 5 == 0 ? readSurface(file, unit)
                             : madeReady(withJoinedCorners(readFile(file)), file, unit);
  }

private:
  int count_ = 0;
};

} // namespace palp::test
