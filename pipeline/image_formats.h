#pragma once

#include <filesystem>
#include <optional>
#include <vtkSmartPointer.h>

class vtkImageData;
class vtkPolyData;

namespace palp
{

// Images read by VTK, each in the patient's axes: x to the left, y to the back, z to the head
// (LPS) [mm]. As in vtk_formats.h: a damaged file may crash the reader.

/// A volume and what brings its points into the patient's axes.
struct PatientImage
{
  vtkSmartPointer<vtkImageData> image;
  double toPatient[16]; ///< row by row, applied to the image's own points [mm]
};

/// @throws Error  BadFile: turned axes, or cut off, which VTK would both pass over
[[nodiscard]] PatientImage readMetaImage(const std::filesystem::path& file);

[[nodiscard]] PatientImage readNifti(const std::filesystem::path& file);

/// @throws Error  BadFile: turned axes
[[nodiscard]] PatientImage readVti(const std::filesystem::path& file);

/// Surface on which an image has one value: the largest connected piece, with the stairs of the
/// voxels smoothed away (windowed sinc, which keeps the volume; Taubin 1996).
///
/// @param level   value; nothing: refused, with the values that there are
/// @param name    stands before each message
/// @return        triangles [mm]; the image's edge cuts the surface open
/// @throws Error  BadMesh: no level, or none of that value; no volume; several values a voxel
[[nodiscard]] vtkSmartPointer<vtkPolyData> levelSurface(
  const PatientImage& volume, std::optional<double> level, const std::string& name);

} // namespace palp
