#pragma once

#include "haptics/error.h"
#include "pipeline/formats/regions/image_labels.h"
#include "pipeline/process/file_organs.h"

#include <array>

namespace palp
{

/// What of an image is a body: what is above a level.
struct ImageRegion
{
  vtkSmartPointer<vtkImageData> image; ///< with room about the body, but for one below the level
  double level = 0.5;
  bool mask = true;                 ///< of voxels that are in or out
  bool below = false;               ///< above the level lower values are meant
  std::vector<std::string> notes{}; ///< how it was taken
};

/// @param name     stands before each message
/// @throws Error   BadMesh: no volume, or no values in it; axes that span no space
void checkVolume(const PatientImage& volume, const std::string& name);

/// @throws Error  BadMesh: voxels that are NaN or infinite, with the first of them
void checkNumbers(const ImageValues& values, const std::string& name);

/// @param labels  one or more
[[nodiscard]] ImageRegion regionOfLabels(const PatientImage& volume, std::span<const Label> labels);

/// What has values from one to another, both included.
/// @throws Error  BadMesh: no voxel has
[[nodiscard]] ImageRegion regionOfBand(
  const PatientImage& volume, const std::array<double, 2>& band, const std::string& name);

/// An image of two values is taken at their middle, whatever level lies between them.
/// @throws Error  BadMesh: none of that value, or voxels that are NaN
[[nodiscard]] ImageRegion regionOfLevel(
  const PatientImage& volume, double level, const ImageValues& values, const std::string& name);

/// Surface and size of a region, in the patient's axes and facing outward.
///
/// @param components  how many of its pieces, the largest first
/// @throws Error      BadMesh: fewer than 8 voxels; more than 10 million triangles
[[nodiscard]] FileOrgan bodyOf(
  const PatientImage& volume, ImageRegion region, std::size_t components, const std::string& name);

/// What holds some voxels whole, in the patient's axes [unit].
[[nodiscard]] Eigen::AlignedBox3d boxInPatient(const PatientImage& volume, const VoxelBox& box);

/// Longest side of all voxels together [unit].
[[nodiscard]] double fieldOf(const PatientImage& volume);

/// A number in a message, with six digits.
[[nodiscard]] std::string inWords(double value);

/// @param code    BadValue where the caller has to say what the image does not tell
/// @throws Error  of that code: the name, and what is wrong with it
[[noreturn]] void refuseImage(
  const std::string& name, const std::string& what, ErrorCode code = ErrorCode::BadMesh);

} // namespace palp
