#pragma once

#include <filesystem>
#include <fstream>

namespace palp::test
{

/// Writes an image of 6 x 4 x 4 voxels of 10 mm whose labels are 2, in 32 of them, and 7, in 16.
inline std::filesystem::path writeLabelMap(const std::filesystem::path& file)
{
  std::ofstream out(file, std::ios::binary);
  out << "NDims = 3\nElementSpacing = 10 10 10\nDistanceUnits = mm\nDimSize = 6 4 4\n"
         "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  for (int row = 0; row < 16; ++row)
  {
    out << '\0' << '\0' << '\0' << '\2' << '\2' << '\7';
  }
  return file;
}

} // namespace palp::test
