#include "pipeline/file_surface.h"

#include <cstring>

namespace palp
{
namespace
{

template <typename Values>
void packValues(std::string& bytes, const Values& values)
{
  const std::size_t count = values.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(
    reinterpret_cast<const char*>(values.data()), count * sizeof(typename Values::value_type));
}

template <typename Values>
void unpackValues(std::string_view& bytes, Values& values)
{
  std::size_t count = 0;
  std::memcpy(&count, bytes.data(), sizeof count);
  values.resize(count);
  std::memcpy(static_cast<void*>(values.data()), bytes.data() + sizeof count,
    count * sizeof(typename Values::value_type));
  bytes.remove_prefix(sizeof count + count * sizeof(typename Values::value_type));
}

} // namespace

std::string pack(const FileSurface& surface)
{
  std::string bytes;
  packValues(bytes, surface.points);
  packValues(bytes, surface.triangles);
  packValues(bytes, surface.unit);
  return bytes;
}

FileSurface unpack(std::string_view bytes)
{
  FileSurface surface;
  unpackValues(bytes, surface.points);
  unpackValues(bytes, surface.triangles);
  unpackValues(bytes, surface.unit);
  return surface;
}

} // namespace palp
