#include "pipeline/formats/images/inflate.h"

#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <istream>
#include <memory>
#include <vector>
#include <zlib.h>

namespace palp
{

void refuseCut(const std::filesystem::path& file, std::uintmax_t there, std::uintmax_t needed)
{
  refuse(file,
    "cut off, its data have " + std::to_string(there) + " of " + std::to_string(needed) +
      " bytes; export or copy it again");
}

void refuseMore(const std::filesystem::path& file, std::uintmax_t there, std::uintmax_t claimed,
  const std::string& remedy)
{
  refuse(file,
    "its data have " + std::to_string(there) + " bytes, more than the " + std::to_string(claimed) +
      " that its header claims; " + remedy + ", or export it again");
}

void inflateInto(std::span<unsigned char> voxels, std::istream& in, std::uintmax_t most,
  const std::filesystem::path& file)
{
  z_stream stream{};
  constexpr int eitherHeader = 32 + MAX_WBITS; // zlib's or gzip's
  if (inflateInit2(&stream, eitherHeader) != Z_OK)
  {
    throw std::bad_alloc();
  }
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> end(&stream, &inflateEnd);
  std::vector<unsigned char> piece(1 << 18);
  constexpr std::size_t step = 1U << 30; // zlib counts in 32 bits
  std::size_t done = 0;
  unsigned char beyond = 0;
  int state = Z_OK;
  while (state == Z_OK)
  {
    if (stream.avail_in == 0)
    {
      const auto size = static_cast<std::streamsize>(std::min<std::uintmax_t>(piece.size(), most));
      in.read(reinterpret_cast<char*>(piece.data()), size);
      most -= static_cast<std::uintmax_t>(in.gcount());
      stream.next_in = piece.data();
      stream.avail_in = static_cast<uInt>(in.gcount());
      if (stream.avail_in == 0)
      {
        refuse(file, "cut off, its compressed data end too early; export or copy it again");
      }
    }
    const bool full = done == voxels.size();
    const auto room = static_cast<uInt>(full ? 1 : std::min(voxels.size() - done, step));
    stream.next_out = full ? &beyond : voxels.data() + done;
    stream.avail_out = room;
    state = inflate(&stream, Z_NO_FLUSH);
    done += room - stream.avail_out;
    if (done > voxels.size())
    {
      refuse(file, "its compressed data hold more than its size says; export it again");
    }
  }
  if (state != Z_STREAM_END)
  {
    refuse(file, "its compressed data are damaged, by their checksum; export or copy it again");
  }
  if (done < voxels.size())
  {
    refuseCut(file, done, voxels.size());
  }
  if (stream.avail_in > 0 || (most > 0 && in.peek() != std::istream::traits_type::eof()))
  {
    refuse(file, "more follows behind its compressed data; export or copy it again");
  }
}

} // namespace palp
