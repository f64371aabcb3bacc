#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace palp::test
{

/// Writes a MetaImage of side^3 voxels of 5 mm, two bytes each.
/// @param valueOf  of the voxel at x, y, z
inline std::filesystem::path writeLabels(
  const std::filesystem::path& file, int side, const std::function<int(int, int, int)>& valueOf)
{
  const std::string size = std::to_string(side) + " ";
  std::ofstream out(file, std::ios::binary);
  out << "NDims = 3\nElementSpacing = 5 5 5\nDistanceUnits = mm\nDimSize = " << size << size << size
      << "\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  for (int i = 0; i < side * side * side; ++i)
  {
    const int value = valueOf(i % side, i / side % side, i / side / side);
    out << static_cast<char>(value & 0xFF) << static_cast<char>(value >> 8 & 0xFF);
  }
  return file;
}

/// Writes two layers of 4 x 4 x 4 voxels as 3D Slicer does, which numbers the segments of each
/// layer anew.
/// @param spacing   side of a voxel [mm]
/// @param segments  their lines of the header
/// @param valuesOf  both layers' of voxel i
inline std::filesystem::path writeLayers(const std::filesystem::path& file, int spacing,
  const std::string& segments, const std::function<std::string(int)>& valuesOf)
{
  const std::string side = std::to_string(spacing);
  std::ofstream out(file, std::ios::binary);
  out << "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 4 4 4\nencoding: raw\n"
         "space: left-posterior-superior\nspace directions: none ("
      << side << ",0,0) (0," << side << ",0) (0,0," << side
      << ")\nspace origin: (0,0,0)\nkinds: list domain domain domain\n"
      << segments << "\n";
  for (int i = 0; i < 64; ++i)
  {
    out << valuesOf(i);
  }
  return file;
}

} // namespace palp::test
