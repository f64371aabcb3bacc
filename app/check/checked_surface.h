#pragma once

#include "app/input/mesh_file.h"
#include "app/input/press_options.h"
#include "pipeline/health/mesh_health.h"
#include "pipeline/health/mesh_repair.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// A surface as its file has it, and what is wrong with it.
struct CheckedSurface
{
  std::filesystem::path file;
  std::vector<Eigen::Vector3d> points; ///< [m]
  std::vector<Triangle> triangles;
  std::string space{};              ///< of its axes, as in FileSurface
  std::vector<std::string> notes{}; ///< of loading, as in LoadedSurface
  MeshHealth health{};
};

/// @throws Error  as readSurface
[[nodiscard]] CheckedSurface checkFile(
  const std::filesystem::path& file, UnitChoice unit, const ImagePart& part);

/// The same of the surface that is felt of a body which is open.
/// @param opened  that file when it was opened
/// @throws Error  also BadFile: it is gone, or another one by now
[[nodiscard]] CheckedSurface checkOpened(const MeshSource& source, const MeshFile& opened);

/// A surface after its repair, and what is wrong with it then.
struct CheckedRepair
{
  RepairedMesh mesh;
  MeshHealth health;
};

/// @param largestHole  as in repairedMesh
[[nodiscard]] CheckedRepair repairedSurface(const CheckedSurface& checked, double largestHole);

/// @throws Error  as writeSurface
void writeRepaired(
  const std::filesystem::path& file, const CheckedRepair& repaired, const CheckedSurface& checked);

/// @throws Error  BadValue: no kind of file that a repaired surface can be written to
void checkRepairName(const std::filesystem::path& file);

/// The length around the largest hole that is closed [m]; 0: none is.
/// @param name    for messages
/// @throws Error  BadValue
[[nodiscard]] double parseLargestHole(const std::string& text, const std::string& name);

} // namespace palp
