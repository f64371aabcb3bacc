#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace palp
{

/// All bytes of a file, as far as they are there.
[[nodiscard]] inline std::string wholeFile(const std::filesystem::path& file)
{
  std::string bytes(std::filesystem::file_size(file), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

} // namespace palp
