#pragma once

#include "pipeline/process/file_surface.h"
#include "pipeline/surface_io/surface_io.h"

#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <tuple>
#include <vector>

namespace palp
{

/// Where a surface came from, so that the same one can be found again.
struct MeshFile
{
  std::string name; ///< without its folder
  std::string
    sha256;          ///< of its bytes, hexadecimal; of MHD and NHDR with those of their data behind
  std::string unit;  ///< that its coordinates were read in
  std::string space; ///< axes of its coordinates: "LPS" of a patient, else empty
  ImagePart part;    ///< of an image
  bool moved = false; ///< by the frame that a scene gives it
};

/// The file, and the one behind it that holds the voxels of an MHD or NHDR.
[[nodiscard]] std::vector<std::filesystem::path> filesBehind(const std::filesystem::path& file);

/// Device, node, size, and times of content and of entry, of a file and of that behind it: others
/// once somebody touched them.
using FileStamps = std::vector<std::tuple<dev_t, ino_t, off_t, time_t, long, time_t, long>>;
[[nodiscard]] FileStamps stampsOf(const std::filesystem::path& file);

/// @throws Error  BadFile: its stamps are others now
void checkUnchanged(const std::filesystem::path& file, const FileStamps& before);

/// See readSurface; a file that cannot be read may have taken the place of another meanwhile.
/// @throws Error  as that, and BadFile: was changed while it was read
[[nodiscard]] LoadedSurface readUnchanged(
  const std::filesystem::path& file, UnitChoice unit, const ImagePart& part);

/// @param file    as named by the user
/// @throws Error  BadFile: cannot be read
[[nodiscard]] MeshFile describeFile(const std::filesystem::path& file);

/// Axes of what all of them are, "LPS" of a patient and not moved; else empty.
[[nodiscard]] std::string spaceOf(const std::vector<MeshFile>& files);

/// Begins the line of a recording that tells what was felt.
inline constexpr std::string_view kFelt = "# felt: ";

/// One line for people and programs: name, hash, unit, frame and level.
[[nodiscard]] std::string describe(const MeshFile& mesh);

/// The same without its name and where a scene puts it: which surface it is.
[[nodiscard]] std::string identityOf(MeshFile mesh);

/// What to tell of a path that was recorded on another surface; empty where nothing says so.
/// @param path  text of the file, whose comments may name the surface
[[nodiscard]] std::string noteOfPath(std::string_view path, const std::vector<MeshFile>& felt);

} // namespace palp
