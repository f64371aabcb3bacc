#pragma once

#include "pipeline/process/file_surface.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace palp
{

inline constexpr int kFewestVoxels = 8; ///< that make a body

/// One of the bodies in an image.
struct FileOrgan
{
  std::string label;        ///< its value; empty: of no label map
  std::string name;         ///< that the image or a table gives it; empty: none
  std::string color{};      ///< that the image gives it, #rrggbb; empty: none
  std::uint64_t voxels = 0; ///< that it has in the image
  double voxelVolume = 0.0; ///< of all of them [unit^3]
  double enclosed = 0.0;    ///< volume of what was taken of it, before it was smoothed [unit^3]
  FileSurface surface;      ///< empty where only a list is asked for
  std::vector<Eigen::Vector3d> from; ///< of its points, where each was before it was smoothed
  double voxel = 0.0;                ///< longest side of one [unit]
  /// lowest and highest corner about its surface, or its voxels where there is none [unit]
  std::array<Eigen::Vector3d, 2> corners{};
};
static_assert(std::is_nothrow_move_constructible_v<FileOrgan>); // else vectors copy when they grow

/// Which of the bodies in an image get a surface; the others are only listed.
struct OrgansAsked
{
  bool isList = false; ///< none, and those are listed as well that are too small for one
  std::optional<std::vector<std::size_t>> places{}; ///< these of the list; nothing: all
};

/// What an image holds.
struct FileOrgans
{
  std::vector<FileOrgan> organs{}; ///< none: it is no label map, and nothing of it is asked for
  double low = 0.0;                ///< its values
  double high = 0.0;
  std::string unit{};               ///< as in FileSurface
  std::string space{};              ///< likewise
  std::vector<std::string> notes{}; ///< on all of it
};

/// @return  bytes for another process on this machine
[[nodiscard]] std::string pack(const FileOrgans& organs);

/// @param bytes  of pack
/// @return       nothing where they are not, or name a point that is not there
[[nodiscard]] std::optional<FileOrgans> unpackOrgans(std::string_view bytes);

} // namespace palp
