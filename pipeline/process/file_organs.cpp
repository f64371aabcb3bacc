#include "pipeline/process/file_organs.h"

#include "pipeline/process/packed_values.h"

#include <utility>

namespace palp
{
namespace
{

void packOrgan(std::string& bytes, const FileOrgan& organ)
{
  packValues(bytes, organ.label);
  packValues(bytes, organ.name);
  packValues(bytes, organ.color);
  packOne(bytes, organ.voxels);
  packOne(bytes, organ.voxelVolume);
  packOne(bytes, organ.enclosed);
  packSurface(bytes, organ.surface);
  packValues(bytes, organ.from);
  packOne(bytes, organ.voxel);
  packOne(bytes, organ.corners[0]);
  packOne(bytes, organ.corners[1]);
}

bool unpackOrgan(std::string_view& bytes, FileOrgan& organ)
{
  return unpackValues(bytes, organ.label) && unpackValues(bytes, organ.name) &&
    unpackValues(bytes, organ.color) && unpackOne(bytes, organ.voxels) &&
    unpackOne(bytes, organ.voxelVolume) && unpackOne(bytes, organ.enclosed) &&
    unpackSurface(bytes, organ.surface) && unpackValues(bytes, organ.from) &&
    unpackOne(bytes, organ.voxel) && unpackOne(bytes, organ.corners[0]) &&
    unpackOne(bytes, organ.corners[1]) && organ.from.size() == organ.surface.points.size();
}

} // namespace

std::string pack(const FileOrgans& organs)
{
  std::string bytes;
  packEach(bytes, organs.organs, packOrgan);
  packOne(bytes, organs.low);
  packOne(bytes, organs.high);
  packValues(bytes, organs.unit);
  packValues(bytes, organs.space);
  packEach(bytes, organs.notes, packValues<std::string>);
  return bytes;
}

std::optional<FileOrgans> unpackOrgans(std::string_view bytes)
{
  FileOrgans organs;
  const bool isRead = unpackEach(bytes, organs.organs, unpackOrgan) &&
    unpackOne(bytes, organs.low) && unpackOne(bytes, organs.high) &&
    unpackValues(bytes, organs.unit) && unpackValues(bytes, organs.space) &&
    unpackEach(bytes, organs.notes, unpackValues<std::string>);
  return isRead && bytes.empty() ? std::optional(std::move(organs)) : std::nullopt;
}

} // namespace palp
