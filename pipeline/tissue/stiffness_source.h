#pragma once

#include "pipeline/tissue/tissue_map.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// From what the stiffness of a body follows, where it is not the same everywhere.
struct StiffnessSource
{
  enum class Kind
  {
    None,    ///< it is the same everywhere
    Labels,  ///< regions of a label map
    Image,   ///< values of an image, in kPa
    Array,   ///< of a surface
    Formula, ///< in x, y, z, r
    Random,
  };

  Kind kind = Kind::None;
  std::filesystem::path file{};       ///< of the first three
  std::string text{};                 ///< name of the array, or the formula
  std::vector<LabelModulus> labels{}; ///< that have a tissue
  RandomTissue random{};

  [[nodiscard]] bool isGiven() const noexcept
  {
    return kind != Kind::None;
  }
};

/// @param unit    of the coordinates of its file, where that names none
/// @param box     of the body in the frame of its file [m]
/// @param off     the surface of the body; empty: an array's is not compared with it
/// @return        empty where none is given
/// @throws Error  as the functions of tissue_map.h, with the key before it
[[nodiscard]] TissueMap tissueMapOf(const StiffnessSource& source, UnitChoice unit,
  const Eigen::AlignedBox3d& box, const SurfaceDistance& off = {});

} // namespace palp
