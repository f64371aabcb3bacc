#include "pipeline/formats/images/nifti_header.h"

#include "pipeline/formats/images/inflate.h"
#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>
#include <string_view>
#include <vector>
#include <zlib.h>

namespace palp
{
namespace
{

constexpr std::size_t kSize = 348;  // [bytes]
constexpr std::size_t kFirst = 352; // [bytes], where the voxels begin at the earliest

struct Start
{
  std::array<unsigned char, kSize> bytes{};
  std::size_t got = 0;

  // in the file's order of bytes, which its first number tells
  [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t count) const
  {
    const bool bigEndian = bytes[0] == 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      value = 256 * value + bytes[at + (bigEndian ? i : count - 1 - i)];
    }
    return value;
  }
  [[nodiscard]] unsigned whole(std::size_t at) const
  {
    return number(at, 2);
  }
  [[nodiscard]] double real(std::size_t at) const
  {
    return double{ std::bit_cast<float>(number(at, 4)) };
  }
};

using GzFile = std::unique_ptr<gzFile_s, decltype(&gzclose_r)>; // packed or not

GzFile opened(const std::filesystem::path& file)
{
  return { gzopen(file.c_str(), "rb"), &gzclose_r };
}

Start startOf(const std::filesystem::path& file, bool& packed)
{
  Start start;
  const GzFile in = opened(file);
  const int got = in ? gzread(in.get(), start.bytes.data(), kSize) : 0;
  int state = Z_OK;
  if (in && (static_cast<void>(gzerror(in.get(), &state)), state == Z_DATA_ERROR))
  {
    refuse(file, "its compressed data are damaged, by their checksum; export or copy it again");
  }
  start.got = static_cast<std::size_t>(std::max(got, 0));
  packed = in && gzdirect(in.get()) == 0;
  return start;
}

void checkKind(const std::filesystem::path& file, const Start& start)
{
  const std::uint32_t size = start.number(0, 4);
  constexpr std::uint32_t second = 540; // [bytes], the header of NIfTI-2
  if (start.got > 4 && size == second)
  {
    refuse(file, "a file of NIfTI-2, which is not read here; save it as NIfTI-1");
  }
  if (start.got < kSize)
  {
    refuse(file, "not a NIfTI file, or cut off in its header; export or copy it again");
  }
  const std::string_view magic(reinterpret_cast<const char*>(start.bytes.data()) + 344, 3);
  if (size != kSize || (magic != "n+1" && magic != "ni1"))
  {
    refuse(file, "not a NIfTI file, whatever its name; rename or convert it");
  }
  if (magic == "ni1")
  {
    refuse(file, "a NIfTI header whose voxels are in a file of their own; save it as one .nii");
  }
}

// [bytes], of a voxel
std::uintmax_t voxelBytes(const std::filesystem::path& file, unsigned type)
{
  static const std::map<unsigned, unsigned> kRead{ { 2, 1 }, { 4, 2 }, { 8, 4 }, { 16, 4 },
    { 64, 8 }, { 256, 1 }, { 512, 2 }, { 768, 4 }, { 1024, 8 }, { 1280, 8 } };
  constexpr std::array kSeveral{ 32U, 128U, 1792U, 2048U, 2304U }; // complex numbers and colors
  const std::string named = " (datatype " + std::to_string(type) + ")";
  if (const auto read = kRead.find(type); read != kRead.end())
  {
    return read->second;
  }
  if (std::ranges::find(kSeveral, type) != kSeveral.end())
  {
    refuse(file, "several values at each voxel" + named + "; give an image of one");
  }
  if (type == 1)
  {
    refuse(file,
      "its voxels are single bits" + named +
        ", which are not read here; save them as bytes (datatype 2)");
  }
  if (type == 1536)
  {
    refuse(file,
      "its voxels are numbers of 16 bytes" + named +
        ", which are not read here; save them in 8 (datatype 64)");
  }
  refuse(file,
    "its datatype is " + std::to_string(type) + ", which is none of NIfTI's; export it again");
}

// NIfTI wants it positive, and programs differ in what they take instead; an sform goes without
void checkSpacing(const std::filesystem::path& file, const Start& start, unsigned dimensions)
{
  const bool sform = start.whole(254) != 0;
  for (unsigned i = 1; i <= std::min(3U, dimensions); ++i)
  {
    const double side = start.real(76 + 4 * std::size_t{ i });
    if (!std::isfinite(side) || side == 0.0 || (side < 0.0 && !sform))
    {
      std::ostringstream words;
      words << "its pixdim[" << i << "] is " << side << ", no size of a voxel; export it again";
      refuse(file, words.str());
    }
  }
}

// of the voxels; some programs leave 0 there, which others take for 348 or 352
std::uintmax_t beginOf(const std::filesystem::path& file, const Start& start)
{
  const double begin = start.real(108);
  constexpr double farthest = 1e9; // [bytes]
  if (!(begin >= kFirst && begin < farthest && begin == std::floor(begin)))
  {
    std::ostringstream words;
    words << "its vox_offset is " << begin << ", but voxels begin at byte " << kFirst
          << " or later; export it again";
    refuse(file, words.str());
  }
  return static_cast<std::uintmax_t>(begin);
}

} // namespace

NiftiHeader readNiftiHeader(const std::filesystem::path& file)
{
  NiftiHeader header;
  const Start start = startOf(file, header.packed);
  checkKind(file, start);
  header.bytes = voxelBytes(file, start.whole(70));
  const unsigned dimensions = start.whole(40);
  if (dimensions < 1 || dimensions > 7)
  {
    refuse(file,
      "its header is damaged, it has " + std::to_string(dimensions) +
        " dimensions; export it again");
  }
  for (unsigned i = 1; i <= dimensions; ++i)
  {
    const unsigned count = start.whole(40 + 2 * std::size_t{ i });
    if (const auto read = static_cast<std::int16_t>(count); read < 0)
    {
      refuse(file,
        "its dim[" + std::to_string(i) + "] is " + std::to_string(read) +
          ", no number of voxels; export it again");
    }
    if (i > 4 && count > 1)
    {
      refuse(file, "several values at each voxel; give an image of one");
    }
    if (i == 4 && count > 1)
    {
      refuse(file,
        "a series of " + std::to_string(count) +
          " volumes, as over time; save one of them as a file of its own (3D Slicer: export the "
          "item of its sequence; FSL: fslroi IN ONE 0 1)");
    }
    header.bytes *= std::max(1U, count);
  }
  checkSpacing(file, start, dimensions);
  header.begin = beginOf(file, start);
  return header;
}

void checkNiftiLength(const std::filesystem::path& file, const NiftiHeader& header)
{
  const std::uintmax_t size = std::filesystem::file_size(file);
  if (header.bytes > (header.packed ? kDeflateRatio * size : size))
  {
    refuse(file,
      "cut off, its header claims " + std::to_string(header.bytes) +
        " bytes of voxels; export or copy it again");
  }
  const GzFile in = opened(file);
  const auto end = static_cast<z_off_t>(header.begin + header.bytes);
  std::uintmax_t beyond = 0;
  if (in && gzseek(in.get(), end, SEEK_SET) == end)
  {
    std::vector<char> piece(1 << 18);
    const auto next = [&]
    { return gzread(in.get(), piece.data(), static_cast<unsigned>(piece.size())); };
    for (int got = next(); got > 0; got = next())
    {
      beyond += static_cast<std::uintmax_t>(got);
    }
  }
  int state = Z_OK; // also of what was read before
  if (in && (static_cast<void>(gzerror(in.get(), &state)), state == Z_DATA_ERROR))
  {
    refuse(file, "its compressed data are damaged, by their checksum; export or copy it again");
  }
  if (state == Z_BUF_ERROR)
  {
    refuse(file, "cut off, its compressed data end too early; export or copy it again");
  }
  if (beyond > 0)
  {
    refuseMore(file, header.bytes + beyond, header.bytes, "mend its dim or datatype");
  }
}

} // namespace palp
