#include "tests/pipeline/formats/dicom_files.h"

#include <Eigen/Geometry>
#include <cmath>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

class Dicom : public DicomFiles
{
};

DicomGrid obliqueGrid()
{
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.4, Vector3d::UnitX()) *
    Eigen::AngleAxisd(2.6, Vector3d(1.0, 2.0, -0.5).normalized()))
                                 .toRotationMatrix();
  return { 33, 44, 30, { 112.0, -240.5, -31.0 }, turn.col(0), turn.col(1), 1.1, 0.75, -1.3 };
}

// of every transfer syntax: within a tenth of a voxel where its header puts it
TEST_F(Dicom, ABallIsWhereItsHeaderSays)
{
  const DicomGrid coronal{ 36, 30, 34, { 50.0, 90.0, 20.0 }, -Vector3d::UnitX(), -Vector3d::UnitZ(),
    1.0, 1.2, 1.0 };
  const std::tuple<const char*, DicomGrid, const char*> all[] = { { "explicit", kAxial,
                                                                    "--write-xfer-little" },
    { "implicit", obliqueGrid(), "--write-xfer-implicit" }, { "big", coronal, "--write-xfer-big" },
    { "deflated", kAxial, "--write-xfer-deflated" }, { "jpegls", obliqueGrid(), "dcmcjpls" },
    { "jpeg", coronal, "dcmcjpeg +e1" }, { "rle", obliqueGrid(), "dcmcrle" } };
  for (const auto& [name, grid, options] : all)
  {
    const Vector3d middle = writeDicom(folder_.path(), name, grid, options);
    const LoadedSurface surface = readSurface(folder_.path() / name, {}, { .level = kDicomLevel });
    EXPECT_TRUE(surface.closed) << name;
    EXPECT_TRUE(mentions(surface, "(LPS)")) << name;
    EXPECT_TRUE(mentions(surface, "\"abdomen\" (CT)")) << name;
    const Mesh mesh = meshOf(surface);
    const double voxel = 1e-3 * std::abs(grid.step);
    double squares = 0.0;
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& point : mesh.points)
    {
      const double off = (point - middle).norm() - 1e-3 * kDicomRadius;
      squares += off * off;
      mean += point / static_cast<double>(mesh.points.size());
    }
    EXPECT_LT((mean - middle).norm(), 0.1 * voxel) << name;
    EXPECT_LT(std::sqrt(squares / static_cast<double>(mesh.points.size())), 0.1 * voxel) << name;
    EXPECT_NEAR(
      volume(mesh), 4.0 / 3.0 * M_PI * std::pow(1e-3 * kDicomRadius, 3), 0.02 * volume(mesh))
      << name;
  }
}

TEST_F(Dicom, OfSeveralSeriesOneIsNamed)
{
  DicomGrid moved = kAxial;
  moved.first.x() += 100.0;
  const Vector3d first = writeDicom(folder_.path(), "both", kAxial, "--write-xfer-little");
  const Vector3d second = writeDicom(folder_.path(), "both", moved, "--write-xfer-little",
    { .series = "1.2.3.2", .description = "late phase" });
  (void)first;
  std::filesystem::create_symlink("loop.dcm", folder_.path() / "both/loop.dcm"); // no image
  EXPECT_NE(refusal("both").find("has 2 series: 1 'abdomen' (CT, 14 images of 40 x 36), 2 'late "
                                 "phase' (CT, 14 images of 40 x 36); name one as the series"),
    std::string::npos)
    << refusal("both");
  EXPECT_NE(refusal("both", { .series = "3" }).find("no series '3' in it"), std::string::npos);
  for (const char* which : { "2", "1.2.3.2" })
  {
    const LoadedSurface surface =
      readSurface(folder_.path() / "both", {}, { .level = kDicomLevel, .series = which });
    double box[6];
    surface.mesh->GetBounds(box);
    EXPECT_NEAR(0.5 * (box[0] + box[1]), second.x(), 1e-4) << which;
  }
}

TEST_F(Dicom, WhatIsNoVolumeIsRefusedByName)
{
  writeDicom(folder_.path(), "gap", kAxial, "--write-xfer-little", { .without = 6 });
  EXPECT_NE(
    refusal("gap").find("are 5 mm apart, the others 2.5 mm: images are missing"), std::string::npos)
    << refusal("gap");
  DicomGrid few = kAxial;
  few.slices = 4;
  writeDicom(folder_.path(), "few", few, "--write-xfer-little", { .without = 2 });
  EXPECT_NE(
    refusal("few").find("are 5 mm apart, the others 2.5 mm: images are missing"), std::string::npos)
    << refusal("few");
  writeDicom(folder_.path(), "uneven", kAxial, "--write-xfer-little");
  const std::filesystem::path last = folder_.path() / "uneven/uneven1_94.dcm";
  std::string moved = test::readAll(last);
  moved.replace(moved.find("835.7"), 5, "836.6");
  std::ofstream(last, std::ios::binary) << moved;
  EXPECT_NE(
    refusal("uneven").find("are 3.4 mm apart, the others 2.5 mm; resample"), std::string::npos)
    << refusal("uneven");
  writeDicom(folder_.path(), "twice", kAxial, "--write-xfer-little");
  std::filesystem::copy(folder_.path() / "twice/twice1_3.dcm", folder_.path() / "twice/again.dcm");
  EXPECT_NE(refusal("twice").find("again.dcm and twice1_3.dcm are in one place"), std::string::npos)
    << refusal("twice");
  DicomGrid one = kAxial;
  one.slices = 1;
  writeDicom(folder_.path(), "one", one, "--write-xfer-little");
  EXPECT_NE(refusal("one").find("one image alone, no volume"), std::string::npos);
  writeDicom(
    folder_.path(), "frames", one, "--write-xfer-little", { .extra = "(0028,0008) IS [20]\n" });
  EXPECT_NE(refusal("frames").find("holds several images in one file"), std::string::npos);
  EXPECT_NE(refusal("frames/frames1_3.dcm").find("several images in one file, and no binary"),
    std::string::npos)
    << refusal("frames/frames1_3.dcm");
  writeDicom(
    folder_.path(), "palette", kAxial, "--write-xfer-little", { .photometric = "PALETTE COLOR" });
  EXPECT_NE(refusal("palette").find("has colors"), std::string::npos) << refusal("palette");
  std::filesystem::create_directory(folder_.path() / "none");
  EXPECT_NE(refusal("none").find("no DICOM image in it"), std::string::npos);
  EXPECT_NE(
    refusal("gap/gap1_3.dcm").find("give the folder that holds all of them"), std::string::npos);
  for (const auto& [name, options] :
    { std::pair("cut", "--write-xfer-little"), { "implicit", "--write-xfer-implicit" },
      { "big", "--write-xfer-big" }, { "deflated", "--write-xfer-deflated" }, { "rle", "dcmcrle" },
      { "jpeg", "dcmcjpeg +e1" }, { "jpegls", "dcmcjpls" } })
  {
    writeDicom(folder_.path(), name, kAxial, options);
    const std::string file = words(name, '/', name, "1_10.dcm");
    for (const double part : { 0.99, 0.7, 0.4 })
    {
      const auto size = static_cast<double>(std::filesystem::file_size(folder_.path() / file));
      std::filesystem::resize_file(folder_.path() / file, static_cast<std::uintmax_t>(part * size));
      EXPECT_NE(refusal(name).find("cut off"), std::string::npos) << part << refusal(name);
    }
  }
  write("ball.obj", "v 0 0 0\n");
  EXPECT_NE(
    refusal("ball.obj", { .series = "1" }).find("no folder of DICOM images; leave the series out"),
    std::string::npos);
}

TEST_F(Dicom, DamagedJpegIsRefused)
{
  writeDicom(folder_.path(), "damaged", kAxial, "dcmcjpeg +e1");
  const std::filesystem::path damaged = folder_.path() / "damaged/damaged1_10.dcm";
  const auto middle = static_cast<std::streamoff>(std::filesystem::file_size(damaged)) - 300;
  std::fstream(damaged, std::ios::in | std::ios::out | std::ios::binary).seekp(middle)
    << "\xff\xd9";
  EXPECT_NE(refusal("damaged").find("10.dcm: its JPEG data are damaged"), std::string::npos);
}

// each distance is within what it may be off by, together they are half a slice
TEST_F(Dicom, DistancesThatDriftAreRefusedByName)
{
  writeDicom(folder_.path(), "drift", kAxial, "--write-xfer-little", { .drift = 0.2 });
  const std::string told = refusal("drift");
  EXPECT_NE(told.find("its images are not evenly far apart"), std::string::npos) << told;
}

// the file is named, and what is wrong with it
TEST_F(Dicom, OneFileThatIsCutOffIsNamed)
{
  writeDicom(folder_.path(), "head", kAxial, "--write-xfer-little");
  const std::filesystem::path file = folder_.path() / "head/head1_10.dcm";
  for (auto size = std::filesystem::file_size(file) - 2; size > 132; size = size * 9 / 10)
  {
    std::filesystem::resize_file(file, size);
    EXPECT_NE(refusal("head").find("head1_10.dcm: cut off"), std::string::npos)
      << size << ' ' << refusal("head");
  }
}

TEST_F(Dicom, OneDamagedFileIsNamedWithTheElement)
{
  using std::string_literals::operator""s;
  const std::string rows = "\x28\0\x10\0US"s;
  const std::string voxels = "\xe0\x7f\x10\0OW\0\0"s;
  const std::tuple<std::string, std::string, const char*> all[] = {
    { rows, "\x28\0\x10\0X?"s, "its element (0028,0010) at byte " },
    { voxels, voxels + "\0\0\0\x60"s, " claims 1610612736 bytes, of which there are " },
    { voxels, "\x28\0\x42\0US\xff\xff"s, "its element (0028,0042) at byte " },
    { voxels, "\x28\0\x42\0SQ\0\0\xff\xff\xff\xff"s, "where an item of a sequence should" },
    { rows, "\x28\0\x09\0US"s, "voxels, but no Rows" },
    { "1.2.840.10008.1.2.1"s, "1.2.840.10008.1.2.9"s, "transfer syntax '1.2.840.10008.1.2.9'" }
  };
  for (const auto& [what, by, words] : all)
  {
    writeDicom(folder_.path(), "one", kAxial, "--write-xfer-little");
    const std::filesystem::path file = folder_.path() / "one/one1_10.dcm";
    std::string bytes = test::readAll(file);
    bytes.replace(bytes.find(what), by.size(), by);
    std::ofstream(file, std::ios::binary) << bytes;
    const std::string told = refusal("one");
    EXPECT_NE(told.find("one1_10.dcm: "), std::string::npos) << told;
    EXPECT_NE(told.find(words), std::string::npos) << told;
  }
}

TEST_F(Dicom, ADescriptionIsReadWhateverItsCode)
{
  for (const char* stored : { "B\xe4uche", "B\xc3\xa4uche" }) // ISO_IR 100 and 192
  {
    writeDicom(folder_.path(), "code", kAxial, "--write-xfer-little", { .description = stored });
    EXPECT_TRUE(mentions(readSurface(folder_.path() / "code", {}, { .level = kDicomLevel }),
      "series \"B\xc3\xa4uche\" (CT)"))
      << stored;
  }
}

// a scanner's report of the dose, or a colored picture, is a series of its own beside the images
TEST_F(Dicom, WhatIsNoVolumeLeavesTheOtherSeriesToBeRead)
{
  writeDicom(folder_.path(), "dose", kAxial, "--write-xfer-little");
  const Vector3d nowhere = Vector3d::Zero();
  std::string header = dicomHeader(kAxial, nowhere, 0, { .series = "1.2.3.9" });
  const std::string place = "(0020,0032) DS [0\\0\\0]\n";
  header.erase(header.find(place), place.size());
  const std::string bytes(std::size_t{ 2 } * 40 * 36, '\0');
  write("dose.raw", bytes);
  write("dose.txt", header + "(7fe0,0010) OW =" + (folder_.path() / "dose.raw").string() + "\n");
  const auto report = folder_.path() / "dose/report.dcm";
  ASSERT_EQ(
    runCommand(words("dump2dcm -q ", (folder_.path() / "dose.txt").string(), ' ', report.string()))
      .code,
    0);
  const std::string fault = "report.dcm: has no Image Position (Patient)";
  for (const char* which : { "", "1" })
  {
    const LoadedSurface surface =
      readSurface(folder_.path() / "dose", {}, { .level = kDicomLevel, .series = which });
    EXPECT_TRUE(mentions(surface, "\"abdomen\" (CT), 14 images")) << which;
    EXPECT_EQ(mentions(surface, fault), *which == '\0') << which;
  }
  for (const char* which : { "2", "1.2.3.9" })
  {
    EXPECT_NE(
      refusal("dose", { .level = kDicomLevel, .series = which }).find(fault), std::string::npos)
      << which;
  }
}

// as on a disk, with the icon of an image
TEST_F(Dicom, ADirectoryBesideTheImagesIsPassedOver)
{
  writeDicom(folder_.path(), "disk", kAxial, "--write-xfer-little");
  write("directory.txt",
    "(0004,1130) CS [DISK]\n(0004,1220) SQ\n(fffe,e000) na\n(0004,1430) CS [IMAGE]\n"
    "(0088,0200) SQ\n(fffe,e000) na\n(0028,0010) US 1\n(0028,0011) US 2\n"
    "(7fe0,0010) OW 0001\n(fffe,e00d) na\n(fffe,e0dd) na\n(fffe,e00d) na\n(fffe,e0dd) na\n"
    "(0008,0016) UI [1.2.840.10008.1.3.10]\n(0008,0018) UI [1.2.3]\n");
  const std::string from = (folder_.path() / "directory.txt").string();
  const std::string to = (folder_.path() / "disk/DICOMDIR").string();
  ASSERT_EQ(runCommand(words("dump2dcm -q ", from, ' ', to)).code, 0);
  EXPECT_EQ(refusal("disk"), "taken");
}

// as archives do to whole blocks; GDCM and DCMTK read on
TEST_F(Dicom, AFileFilledUpWithZerosIsWhole)
{
  writeDicom(folder_.path(), "filled", kAxial, "--write-xfer-little");
  std::ofstream(folder_.path() / "filled/filled1_10.dcm", std::ios::binary | std::ios::app)
    << std::string(512, '\0');
  EXPECT_EQ(refusal("filled"), "taken");
}

// changed by a program that writes whole files
TEST_F(Dicom, OneImageOfAnotherLengthOrPlaceIsNamed)
{
  const auto change = [&](const std::string& how)
  {
    writeDicom(folder_.path(), "one", kAxial, "--write-xfer-little");
    const std::string file = (folder_.path() / "one/one1_10.dcm").string();
    EXPECT_EQ(runCommand(words("dcmodify -q -nb ", how, ' ', file)).code, 0) << how;
    return refusal("one");
  };
  const std::string whole(2 * 40 * 36, '\0');
  for (const std::string& voxels : { whole.substr(whole.size() / 2), whole + whole })
  {
    const std::string file = write("voxels", voxels).string();
    const std::string told = change("-mf '(7fe0,0010)=" + file + "'");
    const std::string expected = words("one1_10.dcm: its Pixel Data are ", voxels.size(), " bytes");
    EXPECT_NE(told.find(expected), std::string::npos) << told;
  }
  for (const double off : { 0.3, -10.0, 30.0 }) // [mm] within the plane; a pixel has 0.8
  {
    const Vector3d place = kAxial.first + Vector3d(0.0, off, 2.5);
    const std::string told =
      change(words("-m '(0020,0032)=", place.x(), '\\', place.y(), '\\', place.z(), "'"));
    EXPECT_NE(
      told.find(words("one1_10.dcm stands ", std::abs(off), " mm beside the line of the others")),
      std::string::npos)
      << told;
  }
}

// as of a patient who got up between, or of two whose files were put together
TEST_F(Dicom, OneImageOfAnotherPatientOrFrameOfReferenceIsNamed)
{
  for (const std::string other : { "(0020,0052)=1.2.3.8", "(0010,0020)=B" })
  {
    writeDicom(folder_.path(), "one", kAxial, "--write-xfer-little",
      { .extra = "(0020,0052) UI [1.2.3.7]\n(0010,0020) LO [A]\n" });
    EXPECT_EQ(refusal("one"), "taken");
    const std::filesystem::path file = folder_.path() / "one/one1_10.dcm";
    ASSERT_EQ(runCommand("dcmodify -q -nb -m '" + other + "' " + file.string()).code, 0);
    const char* what = other.ends_with('B') ? "of another patient than" : "another Frame of Ref";
    EXPECT_NE(refusal("one").find(what), std::string::npos) << refusal("one");
  }
}

} // namespace
} // namespace palp::test
