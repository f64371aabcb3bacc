#include "pipeline/process/file_values.h"

#include "pipeline/process/packed_values.h"

#include <algorithm>
#include <utility>

namespace palp
{
namespace
{

void packName(std::string& bytes, const LabelName& name)
{
  packOne(bytes, name.value);
  packValues(bytes, name.name);
}

bool unpackName(std::string_view& bytes, LabelName& name)
{
  return unpackOne(bytes, name.value) && unpackValues(bytes, name.name);
}

bool isWhole(const FileValues& file)
{
  const auto& [i, j, k] = file.voxels;
  const bool isImage = i > 0 && j > 0 && k > 0;
  const std::size_t count = isImage
    ? static_cast<std::size_t>(i) * static_cast<std::size_t>(j) * static_cast<std::size_t>(k)
    : file.points.size();
  return file.values.size() == count && (isImage || file.voxels == std::array<int, 3>{});
}

} // namespace

std::string pack(const FileValues& file)
{
  std::string bytes;
  packOne(bytes, file.voxels);
  packOne(bytes, file.toSpace);
  packValues(bytes, file.points);
  packValues(bytes, file.values);
  packEach(bytes, file.names, packName);
  packValues(bytes, file.unit);
  return bytes;
}

std::optional<FileValues> unpackFileValues(std::string_view bytes)
{
  FileValues file;
  const bool isRead = unpackOne(bytes, file.voxels) && unpackOne(bytes, file.toSpace) &&
    unpackValues(bytes, file.points) && unpackValues(bytes, file.values) &&
    unpackEach(bytes, file.names, unpackName) && unpackValues(bytes, file.unit);
  return isRead && bytes.empty() && isWhole(file) ? std::optional(std::move(file)) : std::nullopt;
}

} // namespace palp
