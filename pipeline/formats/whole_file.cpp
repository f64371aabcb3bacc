#include "pipeline/formats/whole_file.h"

#include "haptics/error.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>

namespace palp
{
namespace
{

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message)
{
  throw Error(ErrorCode::BadFile, file.string() + ": " + message);
}

} // namespace

void checkXmlEnd(const std::filesystem::path& file)
{
  constexpr std::uintmax_t enough = 1024; // [bytes], for a tag and remarks or blank lines about it
  const std::uintmax_t size = std::filesystem::file_size(file);
  std::string tail(static_cast<std::size_t>(std::min(size, enough)), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  constexpr std::uintmax_t shortest = 32; // that a file cut off later can be
  if (size >= shortest && tail.find("<VTKFile") == tail.npos)
  {
    refuse(file, "not a VTP, VTU or VTI file, whatever its name; rename or convert it");
  }
  in.seekg(static_cast<std::streamoff>(size - tail.size()));
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  if (tail.find("</VTKFile") == tail.npos)
  {
    refuse(file, "cut off, its last tag </VTKFile> is missing; export or copy it again");
  }
}

} // namespace palp
