#pragma once

#include "app/import/organ_level.h"
#include "app/input/mesh_file.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace palp
{

inline constexpr const char* kImportScene = "scene.json";
inline constexpr const char* kImportManifest = "import.json";

/// What an import is made of, besides its organs.
struct ImportSource
{
  std::filesystem::path file;
  FileStamps stamps;   ///< its, before anything of it was read
  MeshFile image;      ///< it, with unit, axes, and what of it is taken
  std::string names{}; ///< file of the labels' names; empty: none
};

/// Files that an earlier import may have left in a folder: those two, and what its manifest lists.
[[nodiscard]] std::vector<std::string> importFiles(const std::filesystem::path& folder);

/// Reads and makes all organs and writes NAME.vtp, and NAME_haptic.vtp where there is a coarser
/// level, which are then forgotten: one organ on each processor at a time.
///
/// @param all     as readFileOrgansAt lists them, with the names and colors they shall have
/// @param files   names of them, without an ending
/// @param source  where they are from
/// @param folder  for the files
/// @param tell    how many are done, on any thread
/// @throws Error  BadFile: it changed meanwhile; as readFileOrgansAt, importedOrgan
[[nodiscard]] std::vector<ImportedOrgan> importedOrgans(FileOrgans all,
  const std::vector<std::string>& files, const ImportSource& source, LengthUnit unit,
  const std::filesystem::path& folder, const std::function<void(std::size_t)>& tell);

/// The scene that opens all organs, files beside it.
[[nodiscard]] std::string importScene(
  const ImportSource& source, const std::vector<ImportedOrgan>& organs);

/// Where the organs are from, by what, and how well each level keeps to its voxels.
[[nodiscard]] std::string importManifest(
  const ImportSource& source, const std::vector<ImportedOrgan>& organs);

} // namespace palp
