#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace palp
{

/// Whether a file is one of DICOM by its preamble, whatever its name: archives give them no ending.
/// @source  DICOM PS3.10, 7.1
[[nodiscard]] inline bool hasDicomMark(const std::filesystem::path& file)
{
  constexpr std::streamoff kPreamble = 128;
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) // a pipe would wait
  {
    return false;
  }
  std::array<char, 4> mark{};
  std::ifstream in(file, std::ios::binary);
  return in.seekg(kPreamble).read(mark.data(), mark.size()) &&
    std::string_view(mark.data(), mark.size()) == "DICM";
}

} // namespace palp
