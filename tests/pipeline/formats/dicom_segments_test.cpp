#include "haptics/error.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/dicom_series.h"

#include <array>
#include <gtest/gtest.h>

// written by DCMTK as PS3.3 (A.51) lays a segmentation out: bits without gaps, the lowest first

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

constexpr int kColumns = 21; // no multiple of eight, so that slices begin within a byte
constexpr int kRows = 18;
constexpr int kSlices = 16;
constexpr double kPixel = 2.0; // [mm]
constexpr double kStep = 2.5;
const Vector3d kFirst(-30.0, 12.0, 700.0);
const Vector3d kAlongRow(0.0, 1.0, 0.0);
const Vector3d kAlongColumn(0.0, 0.0, -1.0);

struct Ball
{
  const char* name;
  int number;
  Vector3d index; // of its middle
  double radius;  // [mm]
};
// the second within the first
const std::array kBalls{ Ball{ "Liver", 1, { 10.0, 8.5, 7.5 }, 14.0 },
  Ball{ "Tumor of liver", 4, { 12.0, 9.0, 8.0 }, 7.0 } };

Vector3d placeOf(const Vector3d& index)
{
  return kFirst + kPixel * (index.x() * kAlongRow + index.y() * kAlongColumn) +
    kStep * index.z() * kAlongRow.cross(kAlongColumn);
}

std::string triple(const Vector3d& v)
{
  return words(v.x(), '\\', v.y(), '\\', v.z());
}

std::string sequence(const std::string& tag, const std::string& items)
{
  return tag + " SQ\n" + items + "(fffe,e0dd) na\n";
}

std::string item(const std::string& elements)
{
  return "(fffe,e000) na\n" + elements + "(fffe,e00d) na\n";
}

class DicomSegments : public testing::Test
{
protected:
  // slices without a voxel of a segment have no frame, and the frames stand in no order
  std::filesystem::path write(const std::string& type = "BINARY", double off = 0.0)
  {
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
        const Vector3d corner =
          placeOf(Vector3d(0, 0, z)) + off * (count == 3 ? 1.0 : 0.0) * kAlongRow;
        frames += item(sequence("(0020,9113)", item("(0020,0032) DS [" + triple(corner) + "]\n")) +
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
    const std::string raw = (folder_.path() / "bits.raw").string();
    std::ofstream(raw, std::ios::binary) << bytes;
    std::string segments;
    for (const Ball& ball : kBalls)
    {
      segments +=
        item(words("(0062,0004) US ", ball.number, "\n(0062,0005) LO [", ball.name, "]\n"));
    }
    const std::string shared =
      sequence("(0020,9116)",
        item("(0020,0037) DS [" + triple(kAlongRow) + "\\" + triple(kAlongColumn) + "]\n")) +
      sequence("(0028,9110)",
        item(words("(0018,0088) DS [", kStep, "]\n(0028,0030) DS [", kPixel, '\\', kPixel, "]\n")));
    const std::string text = (folder_.path() / "seg.txt").string();
    std::ofstream(text) << words("(0008,0016) UI [1.2.840.10008.5.1.4.1.1.66.4]\n"
                                 "(0008,0018) UI [1.2.3.4]\n(0008,0060) CS [SEG]\n"
                                 "(0020,000e) UI [1.2.3]\n(0028,0002) US 1\n(0028,0008) IS [",
      count, "]\n(0028,0010) US ", kRows, "\n(0028,0011) US ", kColumns,
      "\n(0028,0100) US 1\n(0028,0101) US 1\n(0028,0102) US 0\n(0028,0103) US 0\n",
      "(0062,0001) CS [", type, "]\n", sequence("(0062,0002)", segments),
      sequence("(5200,9229)", item(shared)), sequence("(5200,9230)", frames),
      "(7fe0,0010) OB =", raw, "\n");
    const auto file = folder_.path() / "seg.dcm";
    const Finished made =
      runCommand("dump2dcm -q --write-xfer-little " + text + " " + file.string());
    EXPECT_EQ(made.code, 0) << made.err;
    return file;
  }

  static std::string sliceOf(const Ball& ball, int z)
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

  std::string refusal(const std::filesystem::path& file)
  {
    try
    {
      (void)readFileOrgans(file, {}, false);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
};

TEST_F(DicomSegments, AreOrgansWhereTheirSlicesAreAlsoWhereTheyOverlap)
{
  const FileOrgans found = readFileOrgans(write(), {}, false);
  EXPECT_EQ(found.space, "LPS");
  EXPECT_EQ(found.unit, "mm");
  ASSERT_EQ(found.organs.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
  {
    const Ball& ball = kBalls[i];
    const FileOrgan& organ = found.organs[i];
    EXPECT_EQ(organ.name, ball.name);
    EXPECT_EQ(organ.label, std::to_string(ball.number));
    std::uint64_t voxels = 0;
    for (int z = 0; z < kSlices; ++z)
    {
      voxels += static_cast<std::uint64_t>(std::ranges::count(sliceOf(ball, z), '1'));
    }
    EXPECT_EQ(organ.voxels, voxels);
    double squares = 0.0;
    for (const Vector3d& point : organ.surface.points)
    {
      squares += std::pow((point - placeOf(ball.index)).norm() - ball.radius, 2);
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(organ.surface.points.size())), 0.35 * kStep);
  }
}

TEST_F(DicomSegments, ThatAreNoMasksOnAGridAreRefusedByName)
{
  EXPECT_NE(refusal(write("FRACTIONAL")).find("a segmentation of fractions"), std::string::npos);
  EXPECT_NE(refusal(write("BINARY", 0.7)).find("no even stack"), std::string::npos);
  const auto file = write();
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 40);
  EXPECT_NE(refusal(file).find("cut off"), std::string::npos) << refusal(file);
  std::filesystem::create_directory(folder_.path() / "series");
  std::filesystem::rename(write(), folder_.path() / "series/seg.dcm");
  EXPECT_NE(refusal(folder_.path() / "series").find("give this file itself"), std::string::npos);
}

} // namespace
} // namespace palp::test
