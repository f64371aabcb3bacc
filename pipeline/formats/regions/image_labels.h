#pragma once

#include "pipeline/formats/images/patient_image.h"
#include "pipeline/formats/regions/image_values.h"
#include "pipeline/process/file_surface.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palp
{

/// A value as people write it: 2000000000, and not 2e+09.
[[nodiscard]] std::string inDigits(double value);

/// Calls the labels as a table does, also those that the file names itself; but where several
/// layers have one value, which is told.
void giveNames(PatientImage& volume, std::span<const LabelName> names);

/// A region of a label map, and what is known of it.
struct Label
{
  Segment segment;
  double shown = 0.0; ///< its value, as the header scales it
  vtkIdType voxels = 0;
  VoxelBox box; ///< that holds them
};

/// All that have voxels, by layer and value; the background is one of them.
/// @param volume  a label map, or segments in layers
/// @param first   values of its first layer
[[nodiscard]] std::vector<Label> labelsOf(const PatientImage& volume, const ImageValues& first);

/// Those that are bodies: all but the background.
[[nodiscard]] std::vector<Label> bodiesAmong(std::vector<Label> labels);

/// For people: value, name, voxels and volume of each.
[[nodiscard]] std::string labelsInWords(
  const std::vector<Label>& labels, const PatientImage& volume);

/// For people: which segments of the file none of the labels is of; empty: there are none.
[[nodiscard]] std::string emptyInWords(
  const PatientImage& volume, const std::vector<Label>& labels);

/// Volume of a voxel [unit^3].
[[nodiscard]] double voxelVolume(const PatientImage& volume);

/// @param name    stands before each message
/// @throws Error  BadMesh: labels beyond 2^53, which are not told apart
void checkApart(const std::vector<Label>& labels, const std::string& name);

/// Those that words name.
///
/// @param asked   values, or names of segments, with or without capitals
/// @param name    stands before each message
/// @throws Error  BadMesh: none of that value or name, or several, as in layers; says which there
///                are
[[nodiscard]] std::vector<Label> chosenLabels(const std::vector<Label>& labels,
  const std::vector<std::string>& asked, const PatientImage& volume, const std::string& name);

/// The box that holds all of them.
[[nodiscard]] VoxelBox boxOf(std::span<const Label> labels);

/// An image that is 1 where one of some labels is, and 0 all around.
[[nodiscard]] vtkSmartPointer<vtkImageData> maskOfLabels(
  const PatientImage& volume, std::span<const Label> labels);

} // namespace palp
