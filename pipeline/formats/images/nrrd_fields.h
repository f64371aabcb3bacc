#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace palp
{

/// The lines of a header, "name: value" or Slicer's own "name:=value".
using NrrdFields = std::map<std::string, std::string>;

/// The text that an NRRD begins with.
struct NrrdHeader
{
  NrrdFields fields;
  std::uintmax_t end = 0; ///< where the voxels begin [bytes]
};

/// @throws Error  BadFile: no such lines, cut off, or a field given twice
[[nodiscard]] NrrdHeader readNrrdHeader(const std::filesystem::path& file);

/// @return  empty where it is missing
[[nodiscard]] std::string fieldOf(const NrrdFields& fields, const std::string& name);

/// The number that a text is.
/// @param otherwise  where it is none
[[nodiscard]] double numberOf(const std::string& text, double otherwise);

/// The numbers of a text, whatever parentheses and commas stand between them; NaN for other words.
[[nodiscard]] std::vector<double> numbersIn(std::string text);

} // namespace palp
