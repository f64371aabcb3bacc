#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <fstream>

namespace palp::test
{

/// Writes a label map in voxels of 2 mm: a square slab of label 3 on another of label 7, as thick,
/// with two voxels of nothing around both.
///
/// @param side, height  of both together [voxels]; the top is at z = -4 mm, about its middle x = y
/// = 0
inline void writeSlabs(const std::filesystem::path& file, int side, int height)
{
  constexpr int kAround = 2;
  const int wide = side + 2 * kAround;
  const int high = height + 2 * kAround;
  std::ofstream out(file, std::ios::binary);
  out << "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: "
      << wide << ' ' << wide << ' ' << high
      << "\nspace directions: (2,0,0) (0,2,0) (0,0,2)\nkinds: domain domain domain\n"
         "encoding: raw\nspace origin: ("
      << 1 - wide << ',' << 1 - wide << ',' << 1 - 2 * high << ")\n\n";
  const auto isWithin = [](int index, int size)
  { return index >= kAround && index < size - kAround; };
  for (int voxel = 0; voxel < wide * wide * high; ++voxel)
  {
    const int z = voxel / (wide * wide);
    const bool isIn =
      isWithin(voxel % wide, wide) && isWithin(voxel / wide % wide, wide) && isWithin(z, high);
    out.put(static_cast<char>(isIn ? (z < high / 2 ? 7 : 3) : 0));
  }
}

/// Writes a box as OBJ.
/// @param low, high  corners [mm]
inline void writeBox(
  const std::filesystem::path& file, const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  std::ofstream out(file);
  for (int corner = 0; corner < 8; ++corner)
  {
    out << 'v';
    for (int axis = 0; axis < 3; ++axis)
    {
      out << ' ' << ((corner >> axis & 1) != 0 ? high : low)[axis];
    }
    out << '\n';
  }
  out << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

} // namespace palp::test
