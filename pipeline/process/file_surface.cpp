#include "pipeline/process/file_surface.h"

#include <algorithm>
#include <cstring>
#include <utility>

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

bool unpackCount(std::string_view& bytes, std::size_t& count)
{
  if (bytes.size() < sizeof count)
  {
    return false;
  }
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  return true;
}

template <typename Values>
bool unpackValues(std::string_view& bytes, Values& values)
{
  constexpr std::size_t size = sizeof(typename Values::value_type);
  std::size_t count = 0;
  if (!unpackCount(bytes, count) || count > bytes.size() / size)
  {
    return false;
  }
  values.resize(count);
  if (count > 0) // an empty vector has no address to copy to
  {
    std::memcpy(static_cast<void*>(values.data()), bytes.data(), count * size);
  }
  bytes.remove_prefix(count * size);
  return true;
}

bool indicesInRange(const FileSurface& surface)
{
  const auto inRange = [&](int corner)
  { return corner >= 0 && static_cast<std::size_t>(corner) < surface.points.size(); };
  return std::ranges::all_of(surface.triangles,
    [&](const Triangle& triangle) { return std::ranges::all_of(triangle, inRange); });
}

} // namespace

std::string pack(const FileSurface& surface)
{
  std::string bytes;
  packValues(bytes, surface.points);
  packValues(bytes, surface.triangles);
  packValues(bytes, surface.unit);
  const std::size_t notes = surface.notes.size();
  bytes.append(reinterpret_cast<const char*>(&notes), sizeof notes);
  for (const std::string& note : surface.notes)
  {
    packValues(bytes, note);
  }
  return bytes;
}

std::optional<FileSurface> unpack(std::string_view bytes)
{
  FileSurface surface;
  std::size_t notes = 0;
  bool read = unpackValues(bytes, surface.points) && unpackValues(bytes, surface.triangles) &&
    unpackValues(bytes, surface.unit) && unpackCount(bytes, notes);
  while (read && notes-- > 0)
  {
    read = unpackValues(bytes, surface.notes.emplace_back());
  }
  return read && bytes.empty() && indicesInRange(surface) ? std::optional(std::move(surface))
                                                          : std::nullopt;
}

} // namespace palp
