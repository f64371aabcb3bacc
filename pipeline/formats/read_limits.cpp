#include "pipeline/formats/read_limits.h"

#include "pipeline/formats/image_formats.h"
#include "pipeline/formats/images/inflate.h"
#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <string>
#include <unistd.h>

namespace palp
{

namespace
{

struct Sizes
{
  std::uintmax_t file = 0;    // [bytes], of the one that is named
  std::uintmax_t claimed = 0; // [bytes], as far as such a file can hold them
};

Sizes sizesOf(const std::filesystem::path& file)
{
  std::error_code missing;                          // which readFile says
  if (std::filesystem::is_directory(file, missing)) // whose headers are read inside the limits
  {
    Sizes sum;
    for (const auto& entry : std::filesystem::directory_iterator(file, missing))
    {
      sum.file += entry.is_regular_file(missing) ? entry.file_size(missing) : 0;
    }
    return sum;
  }
  if (!std::filesystem::is_regular_file(file, missing))
  {
    return {};
  }
  const std::uintmax_t size = std::filesystem::file_size(file, missing);
  const std::uintmax_t claimed = claimedBytes(file);
  const bool elsewhere = neededFiles(file).front() != file;
  return { size, elsewhere || claimed / kDeflateRatio <= size ? claimed : 0 };
}

std::uintmax_t mostMemory()
{
  const auto there = static_cast<std::uintmax_t>(sysconf(_SC_PHYS_PAGES)) *
    static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE));
  return there / 10 * 9;
}

} // namespace

ChildLimits readLimits(const std::filesystem::path& file)
{
  const Sizes sizes = sizesOf(file);
  const std::uintmax_t most = mostMemory();
  constexpr std::uintmax_t base = 768ULL << 20;
  const std::uintmax_t claimed = std::min(sizes.claimed, most);
  return { .memory = std::min(most, base + 64 * sizes.file + 32 * claimed),
    .time = 4 + (sizes.file >> 20) + (claimed >> 22) };
}

void checkFits(const std::filesystem::path& file)
{
  if (const Sizes sizes = sizesOf(file); sizes.claimed > mostMemory())
  {
    refuse(file,
      "an image of " + std::to_string(sizes.claimed >> 30) +
        " GB, more than this machine's memory; take fewer voxels");
  }
}

std::vector<std::filesystem::path> neededFiles(const std::filesystem::path& file)
{
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return { ending == ".mhd" || ending == ".nhdr" ? file.parent_path() : file };
}

} // namespace palp
