#include "pipeline/process/file_surface.h"

#include "pipeline/process/packed_values.h"

#include <algorithm>
#include <utility>

namespace palp
{
namespace
{

bool indicesInRange(const FileSurface& surface)
{
  const auto inRange = [&](int corner)
  { return corner >= 0 && static_cast<std::size_t>(corner) < surface.points.size(); };
  return std::ranges::all_of(surface.triangles,
    [&](const Triangle& triangle) { return std::ranges::all_of(triangle, inRange); });
}

} // namespace

void packSurface(std::string& bytes, const FileSurface& surface)
{
  packValues(bytes, surface.points);
  packValues(bytes, surface.triangles);
  packValues(bytes, surface.unit);
  packValues(bytes, surface.space);
  packOne(bytes, surface.field);
  packEach(bytes, surface.notes, packValues<std::string>);
}

bool unpackSurface(std::string_view& bytes, FileSurface& surface)
{
  return unpackValues(bytes, surface.points) && unpackValues(bytes, surface.triangles) &&
    unpackValues(bytes, surface.unit) && unpackValues(bytes, surface.space) &&
    unpackOne(bytes, surface.field) &&
    unpackEach(bytes, surface.notes, unpackValues<std::string>) && indicesInRange(surface);
}

std::string pack(const FileSurface& surface)
{
  std::string bytes;
  packSurface(bytes, surface);
  return bytes;
}

std::optional<FileSurface> unpack(std::string_view bytes)
{
  FileSurface surface;
  return unpackSurface(bytes, surface) && bytes.empty() ? std::optional(std::move(surface))
                                                        : std::nullopt;
}

} // namespace palp
