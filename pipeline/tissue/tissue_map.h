#pragma once

#include "pipeline/surface_io/length_unit.h"

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace palp
{

/// Young's modulus at a point of a body [Pa], in the frame of its file [m]; not a number where it
/// is not known.
/// @param young  of the tissue without a map [Pa]
using TissueMap = std::function<double(const Eigen::Vector3d& position, double young)>;

/// The modulus of a region of a label map.
struct LabelModulus
{
  std::string label; ///< value, or name that the file gives it
  double young;      ///< [Pa]
};

/// By the regions of a label map; those that are not named are not known.
/// @param unit    of its coordinates, where the file names none
/// @throws Error  BadFile: unreadable, or no voxel has a label that is named; tells which there are
[[nodiscard]] TissueMap mapOfLabels(
  const std::filesystem::path& file, UnitChoice unit, std::span<const LabelModulus> labels);

/// The labels in a box that are not named, but 0, as in `label 2 (tumor), label 5`.
/// @param box     in the frame of the file [m]
/// @throws Error  as mapOfLabels
[[nodiscard]] std::string otherLabels(const std::filesystem::path& file, UnitChoice unit,
  std::span<const LabelModulus> labels, const Eigen::AlignedBox3d& box);

/// By an image in kPa, as of elastography; 0 where nothing was measured.
/// @throws Error  BadFile: unreadable, a value that is negative or no number, or none above 0
[[nodiscard]] TissueMap mapOfImage(const std::filesystem::path& file, UnitChoice unit);

/// How far a point is off the surface of a body, in the frame of its file [m].
using SurfaceDistance = std::function<double(const Eigen::Vector3d& position)>;

/// By an array of a surface in kPa, or in Pa where its name ends so: in the body as at the nearest
/// place of the surface, which may be a part, a coarser or a smoother copy of the body's own.
/// @param box     of the body, in the frame of its file [m]
/// @param off     the surface of the body; empty: not compared
/// @throws Error  as mapOfImage; BadFile: no such array, or a tenth of the surface's points is
///                farther off the body's than 3 % of its own size and the distance of its points,
///                of which no more than 10 % of its size count
[[nodiscard]] TissueMap mapOfArray(const std::filesystem::path& file, UnitChoice unit,
  const std::string& array, const Eigen::AlignedBox3d& box, const SurfaceDistance& off);

/// By a formula, see TissueFormula.
/// @throws Error  BadValue: as TissueFormula, at a place of the box
[[nodiscard]] TissueMap mapOfFormula(const std::string& formula, const Eigen::AlignedBox3d& box);

/// A tissue whose modulus goes up and down at random about its own, as that of a cirrhotic liver.
struct RandomTissue
{
  double spread = 0.3;  ///< standard deviation over mean [-]
  double length = 8e-3; ///< over which the modulus stays alike [m]
  std::uint32_t seed = 1;

  bool operator==(const RandomTissue&) const = default;
};

/// Its logarithm is a Gaussian field of covariance exp(-distance^2 / 2 length^2); its mean is that
/// of the tissue. The same everywhere in space whatever the box.
/// @source  Shinozuka and Deodatis, Appl. Mech. Rev. 44:191, 1991: sums of cosines
[[nodiscard]] TissueMap mapOfRandom(const RandomTissue& tissue, const Eigen::AlignedBox3d& box);

} // namespace palp
