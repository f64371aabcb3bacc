#include "haptics/error.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/dicom_segmentation.h"
#include "tests/support/dicom_series.h"

#include <fstream>
#include <gtest/gtest.h>

namespace palp::test
{
namespace
{

class DicomSegments : public testing::Test
{
protected:
  std::filesystem::path write(const std::string& type = "BINARY", double off = 0.0)
  {
    return writeSegmentation(folder_.path(), type, off);
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
    for (const std::string& note : organ.surface.notes) // where slices of no segment are left out
    {
      EXPECT_EQ(note.find("border of the image"), std::string::npos) << note;
    }
  }
}

TEST_F(DicomSegments, WithoutAVoxelAreTold)
{
  const auto file = writeSegmentation(folder_.path(), "BINARY", 0.0, { .empty = 9 });
  const FileOrgans found = readFileOrgans(file, {}, false);
  EXPECT_EQ(found.organs.size(), 2U);
  EXPECT_EQ(std::ranges::count(found.notes, "1 segment has no voxel: 'Cyst'"), 1);
}

TEST_F(DicomSegments, ThatAreNoMasksOnAGridAreRefusedByName)
{
  EXPECT_NE(refusal(write("FRACTIONAL")).find("a segmentation that is 'FRACTIONAL', no BINARY"),
    std::string::npos);
  EXPECT_NE(refusal(write("BINARY", 0.7)).find("no even, straight stack"), std::string::npos);
  const auto file = write();
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 40);
  EXPECT_NE(refusal(file).find("cut off"), std::string::npos) << refusal(file);
  std::filesystem::create_directory(folder_.path() / "series");
  std::filesystem::rename(write(), folder_.path() / "series/seg.dcm");
  EXPECT_NE(refusal(folder_.path() / "series").find("give this file itself"), std::string::npos);
}

TEST_F(DicomSegments, WhatContradictsItselfIsRefusedByName)
{
  const auto refused = [&](const OddSegmentation& odd)
  { return refusal(writeSegmentation(folder_.path(), "BINARY", 0.0, odd)); };
  EXPECT_NE(refused({ .again = 2 }).find("two slices of its segment 1 stand in one place"),
    std::string::npos);
  EXPECT_NE(refused({ .first = 9 }).find("a slice of it is of segment 1, which it does not list"),
    std::string::npos);
  EXPECT_NE(refused({ .first = kBalls[1].number }).find("two of its segments have the number 4"),
    std::string::npos);
}

// PS3.3 C.7.6.16.2.4 allows both
TEST_F(DicomSegments, AreReadWhereEachSliceHasItsDirections)
{
  const FileOrgans found = readFileOrgans(
    writeSegmentation(folder_.path(), "BINARY", 0.0, { .isTurnedByFrame = true }), {}, false);
  ASSERT_EQ(found.organs.size(), 2U);
  EXPECT_LT((found.organs[0].surface.points.front() - placeOf(kBalls[0].index)).norm(),
    kBalls[0].radius + kStep);
}

TEST_F(DicomSegments, AreNamedInTheirCharacterSet)
{
  const FileOrgans found =
    readFileOrgans(writeSegmentation(folder_.path(), "BINARY", 0.0,
                     { .characterSet = "ISO_IR 144", .name = "\xbf\xd5\xe7\xd5\xdd\xec" }),
      {}, false);
  ASSERT_EQ(found.organs.size(), 2U);
  EXPECT_EQ(found.organs[0].name, "Печень");
}

// as archives store them
TEST_F(DicomSegments, WhoseFileHasNoEndingAreRead)
{
  const std::filesystem::path file = writeSegmentation(folder_.path(), "BINARY", 0.0, {});
  for (const char* name : { "IM0001", "1.2.840.10008.5" })
  {
    std::filesystem::copy(file, folder_.path() / name);
    EXPECT_EQ(readFileOrgans(folder_.path() / name, {}, true).organs.size(), 2U) << name;
  }
}

TEST_F(DicomSegments, WithoutANameAreNamedByTheirNumber)
{
  const FileOrgans found =
    readFileOrgans(writeSegmentation(folder_.path(), "BINARY", 0.0, { .name = " " }), {}, true);
  ASSERT_EQ(found.organs.size(), 2U);
  EXPECT_EQ(found.organs[0].name, "segment " + found.organs[0].label);
  EXPECT_EQ(found.organs[1].name, kBalls[1].name);
}

// contours of a plan of radiotherapy
TEST_F(DicomSegments, AFileThatHoldsNoImageIsNamedByItsModality)
{
  const std::string text = (folder_.path() / "plan.txt").string();
  const std::filesystem::path file = folder_.path() / "plan.dcm";
  std::ofstream(text) << "(0008,0016) UI [1.2.840.10008.5.1.4.1.1.481.3]\n"
                         "(0008,0018) UI [1.2.3]\n(0008,0060) CS [RTSTRUCT]\n";
  ASSERT_EQ(runCommand("dump2dcm -q " + text + ' ' + file.string()).code, 0);
  EXPECT_NE(refusal(file).find("no image, by its Modality 'RTSTRUCT'"), std::string::npos)
    << refusal(file);
}

// which would be read as if they were Hounsfield units
TEST_F(DicomSegments, ASeriesWhoseValuesGoByATableIsRefused)
{
  const DicomGrid grid{ 16, 16, 4, { -20.0, -20.0, 300.0 }, Eigen::Vector3d::UnitX(),
    Eigen::Vector3d::UnitY(), 2.5, 2.5, 8.0 };
  writeDicom(folder_.path(), "table", grid, "--write-xfer-little",
    { .extra = "(0028,3000) SQ\n(fffe,e000) na\n(0028,3002) US 2\\0\\16\n(0028,3004) LO [HU]\n"
               "(0028,3006) US 0\\2000\n(fffe,e00d) na\n(fffe,e0dd) na\n" });
  const std::string told = refusal(folder_.path() / "table");
  EXPECT_NE(told.find("its values go by a Modality LUT"), std::string::npos) << told;
}

} // namespace
} // namespace palp::test
