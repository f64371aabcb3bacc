#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// One image of a DICOM series, without its voxels.
struct DicomSlice
{
  std::filesystem::path file;
  int columns = 0;
  int rows = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< of the first voxel's middle, LPS [mm]
  Eigen::Vector3d alongRow = Eigen::Vector3d::Zero(); ///< unit vector, LPS
  Eigen::Vector3d alongColumn = Eigen::Vector3d::Zero();
  double columnSpacing = 0.0; ///< between columns, along a row [mm]
  double rowSpacing = 0.0;    ///< [mm]
  double slope = 1.0;         ///< a voxel's value is slope times what is stored, plus intercept
  double intercept = 0.0;
  bool isScaled = false; ///< the file states these two
  std::string frame{};   ///< UID of the Frame of Reference; empty: not told
  std::string patient{}; ///< Patient ID; empty: not told
  std::string phase{};   ///< Echo Time and Temporal Position Identifier, as they stand there
};

/// The images of a folder that one SeriesInstanceUID holds together.
struct DicomSeries
{
  std::string uid;
  std::string description;
  std::string modality; ///< as CT
  int number = 0;
  std::vector<DicomSlice> slices;
  std::string fault{}; ///< why it is no volume, as a report or a picture; empty: it may be one
};

/// The series in a folder, by their numbers, those with a fault last. Files that are no DICOM
/// images are passed over.
///
/// @param folder   without the folders in it
/// @throws Error   BadFile: none; a file that is cut off or damaged
[[nodiscard]] std::vector<DicomSeries> dicomSeriesIn(const std::filesystem::path& folder);

/// The one that is asked for.
///
/// @param asked   its place in the list, from 1, or its UID; empty: the only one without a fault
/// @param notes   gets the faults of the others, where nothing is asked
/// @throws Error  BadFile: none; its fault; BadValue: several and nothing asked, which are listed
[[nodiscard]] DicomSeries chosenSeries(
  const std::filesystem::path& folder, const std::string& asked, std::vector<std::string>& notes);

/// Orders the slices from the first voxel on, so that row, column and order are right-handed.
///
/// @return        from one to the next, which may lean a little [mm]
/// @throws Error  BadFile: a tilted gantry, unlike slices, one missing, two in one place, one alone
[[nodiscard]] Eigen::Vector3d stack(const std::filesystem::path& folder, DicomSeries& series);

} // namespace palp
