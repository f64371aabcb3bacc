#pragma once

#include "pipeline/formats/images/patient_image.h"
#include "pipeline/process/file_organs.h"
#include "pipeline/process/file_values.h"

#include <filesystem>

namespace palp
{

/// Who reads images of DICOM: none, unless a program brings them.
struct DicomReaders
{
  /// Of a folder, a series by its place there or its UID.
  PatientImage (*series)(const std::filesystem::path& folder, const std::string& series) = nullptr;
  PatientImage (*segments)(const std::filesystem::path& file) = nullptr;
};

/// Reads STL, OBJ, PLY, OFF, legacy VTK, VTP, VTU or MSH, by the ending of the name, of a volume
/// mesh its outer surface; or a surface in an image: MetaImage, NIfTI or VTI.
///
/// Polygons and strips are cut into triangles; a surface whose file says SPACE=RAS is turned to
/// LPS, as 3D Slicer does. For palp-read only: a damaged file may crash the reader or take all
/// memory, and VTK reads numbers by the locale.
///
/// @param part    of an image; none for a file that is a surface itself
/// @param dicom   for a folder, or a file whose name ends in .dcm
/// @throws Error  BadFile: missing, not a file, empty, cut off, not of the format its name says;
///                BadMesh: no triangles, a coordinate that is not a number; as imageSurface
[[nodiscard]] FileSurface readFile(
  const std::filesystem::path& file, const ImagePart& part = {}, const DicomReaders& dicom = {});

/// The bodies in an image, by imageOrgans.
/// @throws Error  BadFile: a surface, no image; else as readFile
[[nodiscard]] FileOrgans readOrgans(const std::filesystem::path& file, const ImagePart& part,
  const OrgansAsked& asked, const DicomReaders& dicom = {});

/// The values of an image, or of an array of a surface.
/// @param array   its name; empty: the file is an image
/// @throws Error  BadFile: the other kind of file; as imageValues, arrayValues, readFile
[[nodiscard]] FileValues readValues(
  const std::filesystem::path& file, const std::string& array, const DicomReaders& dicom = {});

} // namespace palp
