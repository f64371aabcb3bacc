#pragma once

#include "pipeline/formats/images/patient_image.h"

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <gdcmDataSet.h>
#include <gdcmReader.h>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palp
{

// What elements of DICOM hold, without trust in what is written there.

/// SOP class of a segmentation: several masks in one file.
inline constexpr const char* kSegmentationClass = "1.2.840.10008.5.1.4.1.1.66.4";

/// In UTF-8, without the blanks and zeros that fill it up; empty: not there.
/// @param characterSet  Specific Character Set of the file or of the item, as inUtf8() takes it
[[nodiscard]] std::string textOf(
  const gdcm::DataSet& data, const gdcm::Tag& tag, std::string_view characterSet = {});

inline const gdcm::Tag kCharacterSet(0x0008, 0x0005);
inline const gdcm::Tag kFrames(0x0028, 0x0008); ///< how many images a file holds

/// As many decimals as are asked for; nothing where there are others.
[[nodiscard]] std::optional<std::vector<double>> decimalsOf(
  const gdcm::DataSet& data, const gdcm::Tag& tag, std::size_t count);

/// One decimal.
/// @param usual  where there is none
[[nodiscard]] double decimalOf(const gdcm::DataSet& data, const gdcm::Tag& tag, double usual);

/// A number of two bytes in this machine's order; 0 where there is none.
[[nodiscard]] int countOf(const gdcm::DataSet& data, const gdcm::Tag& tag);

/// What stands in the items of a sequence; none where there is no such sequence.
[[nodiscard]] std::vector<gdcm::DataSet> itemsOf(const gdcm::DataSet& data, const gdcm::Tag& tag);

/// What stands in the only item of a sequence, as groups of functions have it; empty: in none.
[[nodiscard]] gdcm::DataSet groupOf(const gdcm::DataSet& groups, const gdcm::Tag& tag);

/// From now on what GDCM warns of is kept, and nothing is printed.
void listenToGdcm();

/// Whether GDCM has since filled up what a file was cut off of.
[[nodiscard]] bool wasFilledUp();

/// Whether its decoder has since found that JPEG data are damaged, and gone on.
[[nodiscard]] bool isDamagedJpeg();

/// Reads a file, without what GDCM says of it.
/// @return  false also where it is filled up
[[nodiscard]] bool readWhole(gdcm::Reader& reader, const std::filesystem::path& file);

/// Where an image of DICOM stands, whose axes and millimeters are the patient's.
/// @param along  rows, columns and slices, unit vectors
/// @param first  middle of the first voxel [mm]
void placeInPatient(
  PatientImage& image, const std::array<Eigen::Vector3d, 3>& along, const Eigen::Vector3d& first);

} // namespace palp
