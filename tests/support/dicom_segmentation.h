#pragma once

#include "tests/support/dicom_series.h"

#include <array>
#include <cstddef>

// A segmentation, written by DCMTK as PS3.3 (A.51) lays it out: bits without gaps, the lowest
// first.

namespace palp::test
{

using Eigen::Vector3d;

inline constexpr int kColumns = 21; // no multiple of eight, so that slices begin within a byte
inline constexpr int kRows = 18;
inline constexpr int kSlices = 16;
inline constexpr double kPixel = 2.0; // [mm]
inline constexpr double kStep = 2.5;
inline const Vector3d kFirst(-30.0, 12.0, 700.0);
inline const Vector3d kAlongRow(0.0, 1.0, 0.0);
inline const Vector3d kAlongColumn(0.0, 0.0, -1.0);

struct Ball
{
  const char* name;
  int number;
  Vector3d index; // of its middle
  double radius;  // [mm]
};
// the second within the first
inline const std::array kBalls{ Ball{ "Liver", 1, { 10.0, 8.5, 7.5 }, 14.0 },
  Ball{ "Tumor of liver", 4, { 12.0, 9.0, 8.0 }, 7.0 } };

inline Vector3d placeOf(const Vector3d& index)
{
  return kFirst + kPixel * (index.x() * kAlongRow + index.y() * kAlongColumn) +
    kStep * index.z() * kAlongRow.cross(kAlongColumn);
}

inline std::string triple(const Vector3d& v)
{
  return words(v.x(), '\\', v.y(), '\\', v.z());
}

inline std::string sequence(const std::string& tag, const std::string& items)
{
  return tag + " SQ\n" + items + "(fffe,e0dd) na\n";
}

inline std::string item(const std::string& elements)
{
  return "(fffe,e000) na\n" + elements + "(fffe,e00d) na\n";
}

inline std::string sliceOf(const Ball& ball, int z)
{
  std::string bits;
  for (int y = 0; y < kRows; ++y)
  {
    for (int x = 0; x < kColumns; ++x)
    {
      const Vector3d from = placeOf(Vector3d(x, y, z)) - placeOf(ball.index);
      bits += from.norm() < ball.radius ? '1' : '0';
    }
  }
  return bits;
}

// What of a segmentation is not as usual.
struct OddSegmentation
{
  int first = kBalls[0].number; // number that the first segment is listed under
  int again = -1;               // frame that stands where the one before it does
  bool isTurnedByFrame = false; // the orientation stands in each frame instead of once
  std::string characterSet{};   // and what the first segment is called in it
  std::string name = kBalls[0].name;
  int empty = 0; // number of one more, without a voxel; 0: none
};

// slices without a voxel of a segment have no frame, and the frames stand in no order
inline std::filesystem::path writeSegmentation(const std::filesystem::path& folder,
  const std::string& type = "BINARY", double off = 0.0, const OddSegmentation& odd = {})
{
  const std::string orientation = sequence("(0020,9116)",
    item("(0020,0037) DS [" + triple(kAlongRow) + "\\" + triple(kAlongColumn) + "]\n"));
  std::string frames;
  std::string bits;
  int count = 0;
  for (const Ball& ball : kBalls)
  {
    for (int z = kSlices - 1; z >= 0; --z)
    {
      const std::string slice = sliceOf(ball, z);
      if (slice.find('1') == slice.npos)
      {
        continue;
      }
      bits += slice;
      const Vector3d corner = placeOf(Vector3d(0, 0, count == odd.again ? z + 1 : z)) +
        off * (count == 3 ? 1.0 : 0.0) * kAlongRow;
      frames += item((odd.isTurnedByFrame ? orientation : "") +
        sequence("(0020,9113)", item("(0020,0032) DS [" + triple(corner) + "]\n")) +
        sequence("(0062,000a)", item(words("(0062,000b) US ", ball.number, "\n"))));
      ++count;
    }
  }
  std::string bytes((bits.size() + 7) / 8, '\0');
  bytes.resize(bytes.size() + bytes.size() % 2);
  for (std::size_t i = 0; i < bits.size(); ++i)
  {
    bytes[i / 8] = static_cast<char>(bytes[i / 8] | (bits[i] == '1' ? 1 << i % 8 : 0));
  }
  const std::string raw = (folder / "bits.raw").string();
  std::ofstream(raw, std::ios::binary) << bytes;
  std::string segments;
  for (const Ball& ball : kBalls)
  {
    const bool isFirst = &ball == kBalls.data();
    segments += item(words("(0062,0004) US ", isFirst ? odd.first : ball.number,
      "\n(0062,0005) LO [", isFirst ? odd.name : ball.name, "]\n"));
  }
  segments +=
    odd.empty > 0 ? item(words("(0062,0004) US ", odd.empty, "\n(0062,0005) LO [Cyst]\n")) : "";
  const std::string shared = (odd.isTurnedByFrame ? "" : orientation) +
    sequence("(0028,9110)",
      item(words("(0018,0088) DS [", kStep, "]\n(0028,0030) DS [", kPixel, '\\', kPixel, "]\n")));
  const std::string text = (folder / "seg.txt").string();
  std::ofstream(text) << words("(0008,0005) CS [", odd.characterSet,
    "]\n(0008,0016) UI [1.2.840.10008.5.1.4.1.1.66.4]\n"
    "(0008,0018) UI [1.2.3.4]\n(0008,0060) CS [SEG]\n"
    "(0020,000e) UI [1.2.3]\n(0028,0002) US 1\n(0028,0008) IS [",
    count, "]\n(0028,0010) US ", kRows, "\n(0028,0011) US ", kColumns,
    "\n(0028,0100) US 1\n(0028,0101) US 1\n(0028,0102) US 0\n(0028,0103) US 0\n",
    "(0062,0001) CS [", type, "]\n", sequence("(0062,0002)", segments),
    sequence("(5200,9229)", item(shared)), sequence("(5200,9230)", frames), "(7fe0,0010) OB =", raw,
    "\n");
  const auto file = folder / "seg.dcm";
  const Finished made = runCommand("dump2dcm -q --write-xfer-little " + text + " " + file.string());
  EXPECT_EQ(made.code, 0) << made.err;
  return file;
}

} // namespace palp::test
