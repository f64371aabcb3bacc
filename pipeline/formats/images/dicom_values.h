#pragma once

#include <cstddef>
#include <filesystem>
#include <gdcmDataSet.h>
#include <gdcmReader.h>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

// What elements of DICOM hold, without trust in what is written there.

/// SOP class of a segmentation: several masks in one file.
inline constexpr const char* kSegmentationClass = "1.2.840.10008.5.1.4.1.1.66.4";

/// Without the blanks and zeros that fill it up; empty: not there.
[[nodiscard]] std::string textOf(const gdcm::DataSet& data, const gdcm::Tag& tag);

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

/// Reads a file, without what GDCM says of it.
/// @return  false also where GDCM fills up what it was cut off of
[[nodiscard]] bool readWhole(gdcm::Reader& reader, const std::filesystem::path& file);

} // namespace palp
