#pragma once

#include "app/input/mesh_file.h"
#include "app/input/scene_plan.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

struct Recording;

/// What an export folder tells of itself: scene.json, from which all else there follows, and
/// provenance.json.
struct ExportFolder
{
  std::filesystem::path folder{};
  ScenePlan plan{};
  std::string version{};           ///< of the program that wrote it
  std::string command{};           ///< that made it, as for a shell
  std::string device{};            ///< that held the tool
  std::vector<MeshFile> inputs{};  ///< name and hash of what it was made from
  std::vector<MeshFile> outputs{}; ///< and of what it holds
  std::vector<MeshFile> beside{};  ///< and of what was added, which palp run does not repeat
};

/// The names of all files that an export may leave.
[[nodiscard]] std::vector<std::string> exportFiles();

/// Whether a path names a folder with a scene.json.
[[nodiscard]] bool isExport(const std::filesystem::path& folder);

/// The same, and refuses a folder that would be one but for its scene.json, or that is empty.
/// @throws Error  BadFile
[[nodiscard]] bool isWholeExport(const std::filesystem::path& folder);

/// @throws Error  BadFile: a file is missing, is none of this kind, or as readScene
[[nodiscard]] ExportFolder readExport(const std::filesystem::path& folder);

/// Where an export of the window holds the recordings before its last.
/// @param take  from 1, the first of all
[[nodiscard]] std::filesystem::path earlierTake(
  const std::filesystem::path& folder, std::size_t take);

/// The exports that an export consists of, the first recording first; the folder itself where it
/// is none.
[[nodiscard]] std::vector<std::filesystem::path> takesIn(const std::filesystem::path& folder);

/// Writes scene.json and the path that it names, path.csv.
///
/// @param stage   where the files wait
/// @param path    text of the plan's path; empty where it has none
/// @throws Error  BadFile: cannot be written
void writeScene(const std::filesystem::path& stage, ScenePlan plan, const std::string& path);

/// Writes provenance.json, of what the stage holds: last.
///
/// @throws Error  BadFile: cannot be read or written
void writeProvenance(
  const std::filesystem::path& stage, const ScenePlan& plan, const Recording& recording);

/// Adds name and hash of files that were written into the folder afterwards, which palp run does
/// not repeat.
///
/// @param names   in the folder
/// @throws Error  BadFile: cannot be read or written
void addToProvenance(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Refuses to repeat what was made from other files.
/// @throws Error  BadFile: names the first that has changed
void checkInputs(const ExportFolder& made, const ScenePlan& plan, const Recording& recording);

/// The files that differ from what the folder says they were.
/// @param stage  what was made anew, or the folder itself, as it is now
[[nodiscard]] std::vector<std::string> differences(
  const ExportFolder& made, const std::filesystem::path& stage);

} // namespace palp
