#pragma once

#include "haptics/surface/sampling/deviation.h"
#include "pipeline/process/file_organs.h"
#include "pipeline/surface_io/length_unit.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace palp
{

inline constexpr const char* kHaptic = "_haptic"; ///< behind the name of a file of fewer points

/// A surface of an organ, and how far it is from the boundary of its voxels.
struct OrganLevel
{
  std::size_t points = 0; ///< 0: there is none
  std::size_t triangles = 0;
  Deviation apart{};
};

/// An organ on its way from an image to files.
struct ImportedOrgan
{
  std::string name;    ///< as the image or a table has it, or of its label
  std::string file;    ///< without ending, alone among those of an import
  std::string label;   ///< its value; empty: of no label map
  std::string color{}; ///< that the image gives it, #rrggbb; empty: none
  std::uint64_t voxels = 0;
  double voxelVolume = 0.0; ///< of all of them [m^3]
  double enclosed = 0.0;    ///< volume of the pieces that were taken, as the voxels have it [m^3]
  double volume = 0.0;      ///< of the surface [m^3]
  OrganLevel shown;         ///< none: it has no surface, which the warnings tell
  std::optional<OrganLevel> felt{};    ///< where fewer points serve as well
  std::vector<std::string> notes{};    ///< how it was taken from the image
  std::vector<std::string> warnings{}; ///< for people
};

/// Gets the surfaces of an organ as they are ready, from any thread.
/// @param behind  the name of its file: kHaptic or nothing
/// @param mesh    [m]
using SaveSurface = std::function<void(const std::string& behind, vtkPolyData& mesh)>;

/// Makes an organ ready: repaired and facing outward, in two levels of detail.
///
/// @param organ   with its surface, which is used up
/// @param image   that it is from, for messages
/// @throws Error  as madeReady, and what save throws
[[nodiscard]] ImportedOrgan importedOrgan(
  FileOrgan organ, const std::filesystem::path& image, LengthUnit unit, const SaveSurface& save);

/// The unit of all organs: that which is asked for or stated, or the one that their common size
/// tells.
/// @param warnings  gets that it was guessed
/// @throws Error    BadMesh: as guessUnit
[[nodiscard]] LengthUnit unitOf(const FileOrgans& organs, UnitChoice asked,
  const std::filesystem::path& image, std::vector<std::string>& warnings);

/// The unit of organs that are only listed: that which is asked for or stated, or the one that
/// their volume and the image's size tell; nothing where these do not.
/// @param note  gets that it was guessed, or could not be
[[nodiscard]] UnitChoice unitOfList(const FileOrgans& organs, UnitChoice asked,
  const std::filesystem::path& image, std::string& note);

} // namespace palp
