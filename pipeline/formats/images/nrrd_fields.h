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

/// The text that an NRRD begins with, or that is a file of its own, .nhdr.
struct NrrdHeader
{
  NrrdFields fields;
  std::filesystem::path data{}; ///< file of the voxels
  std::uintmax_t begin = 0;     ///< where they begin in it [bytes]
};

/// Whether a file is a header whose voxels are in another, by its name.
[[nodiscard]] bool isNrrdHeader(const std::filesystem::path& file);

/// @throws Error  BadFile: no such lines, cut off, or a field given twice; voxels in another file
///                than the one beside an .nhdr
[[nodiscard]] NrrdHeader readNrrdHeader(const std::filesystem::path& file);

/// @return  empty where it is missing
[[nodiscard]] std::string fieldOf(const NrrdFields& fields, const std::string& name);

/// The number that a text is.
/// @param otherwise  where it is none
[[nodiscard]] double numberOf(const std::string& text, double otherwise);

/// The numbers of a text, whatever parentheses and commas stand between them; NaN for other words.
[[nodiscard]] std::vector<double> numbersIn(std::string text);

} // namespace palp
