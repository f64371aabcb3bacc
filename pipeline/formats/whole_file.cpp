#include "pipeline/formats/whole_file.h"

#include "haptics/error.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace palp
{
namespace
{

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message)
{
  throw Error(ErrorCode::BadFile, file.string() + ": " + message);
}

struct PlyElement
{
  std::string name;
  std::uintmax_t count = 0;
  std::uintmax_t bytes = 0; // of one, at least: a face has three corners
};

std::uintmax_t sizeOf(const std::string& type)
{
  static const std::map<std::string, std::uintmax_t> kSizes{ { "char", 1 }, { "uchar", 1 },
    { "int8", 1 }, { "uint8", 1 }, { "short", 2 }, { "ushort", 2 }, { "int16", 2 },
    { "uint16", 2 }, { "int", 4 }, { "uint", 4 }, { "int32", 4 }, { "uint32", 4 }, { "float", 4 },
    { "float32", 4 }, { "double", 8 }, { "float64", 8 } };
  const auto size = kSizes.find(type);
  return size == kSizes.end() ? 0 : size->second;
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

void checkPlyEnd(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::vector<PlyElement> elements;
  bool text = false;
  bool whole = false;
  constexpr int most = 1000; // lines of a header
  std::string line;
  for (int i = 0; i < most && !whole && std::getline(in, line); ++i)
  {
    std::istringstream words(line);
    std::string word;
    std::string kind;
    words >> word >> kind;
    text = text || (word == "format" && kind == "ascii");
    whole = word == "end_header";
    if (word == "element")
    {
      PlyElement element{ .name = kind };
      words >> element.count;
      elements.push_back(element);
    }
    else if (word == "property" && !elements.empty())
    {
      std::string count;
      std::string type;
      words >> count >> type;
      constexpr std::uintmax_t corners = 3;
      elements.back().bytes +=
        kind == "list" ? sizeOf(count) + corners * sizeOf(type) : sizeOf(kind);
    }
  }
  if (!whole)
  {
    refuse(file, "cut off in its header, or that is damaged; export or copy it again");
  }
  std::uintmax_t left = std::filesystem::file_size(file) - static_cast<std::uintmax_t>(in.tellg());
  for (const auto& [name, count, bytes] : elements)
  {
    const std::uintmax_t each = text ? 2 : bytes; // a digit and the end of a line
    if (each > 0 && left / each + (text ? 1 : 0) < count)
    {
      refuse(file,
        "cut off, or its header damaged: it counts " + std::to_string(count) + " of " + name +
          ", and what follows is shorter; export or copy it again");
    }
    left -= std::min(left, each * count);
  }
  std::uintmax_t lines = 0;
  std::uintmax_t counted = 0;
  for (const PlyElement& element : elements)
  {
    counted += element.count;
  }
  for (; text && lines < counted && std::getline(in, line);)
  {
    lines += line.find_first_not_of(" \t\r") != line.npos;
  }
  if (text && lines < counted)
  {
    refuse(file,
      "cut off, it has " + std::to_string(lines) + " of " + std::to_string(counted) +
        " lines behind its header; export or copy it again");
  }
}

} // namespace palp
