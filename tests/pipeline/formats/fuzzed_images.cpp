#include "pipeline/formats/dicom/dicom_image.h"
#include "pipeline/formats/dicom/dicom_segments.h"
#include "pipeline/formats/surface_formats.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/formats/fuzzed_parts.h"
#include "tests/support/deflated.h"
#include "tests/support/dicom_segmentation.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataWriter.h>

namespace palp::test
{
namespace
{

constexpr int kSide = 10; // voxels

// distance to a ball [mm]
vtkSmartPointer<vtkImageData> ballImage()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(kSide, kSide, kSide);
  image->SetSpacing(5.0, 5.0, 6.0);
  image->AllocateScalars(VTK_FLOAT, 1);
  const Eigen::Vector3d center(22.0, 23.0, 27.0);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double distance = (Eigen::Vector3d(image->GetPoint(i)) - center).norm() - 15.0;
    image->GetPointData()->GetScalars()->SetComponent(i, 0, distance);
  }
  return image;
}

constexpr std::size_t kVoxelBytes = kSide * kSide * kSide * sizeof(float);

} // namespace

std::string voxelBytes()
{
  return { static_cast<const char*>(ballImage()->GetScalarPointer()), kVoxelBytes };
}

namespace
{

std::string zipped(const std::string& bytes)
{
  return deflated(bytes, MAX_WBITS + 16);
}

std::string metaHeader(const std::string& more, const std::string& data)
{
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" +
    more +
    "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 5 5 6\n"
    "DimSize = 10 10 10\nElementType = MET_FLOAT\nElementDataFile = " +
    data + "\n";
}

std::vector<Fuzzed> metaKinds()
{
  const std::string raw = metaHeader("CompressedData = False\n", "LOCAL") + voxelBytes();
  const std::string packed = deflated(voxelBytes(), MAX_WBITS);
  const std::string compressed =
    metaHeader(
      "CompressedData = True\nCompressedDataSize = " + std::to_string(packed.size()) + "\n",
      "LOCAL") +
    packed;
  const std::vector<Fault> header{ cutOff(kCut, 60),
    replaced("size", "(DimSize = )[0-9]+", "$01999", kCount),
    replaced("no size", "(DimSize = )[0-9]+", "$01-1", "DimSize"),
    replaced("size in words", "(DimSize = )[0-9]+", "$01ten", "DimSize"),
    replaced("type", "MET_FLOAT", "MET_REAL", "ElementType"),
    replaced("spacing", "(ElementSpacing = )[0-9]+", "$010", "ElementSpacing"),
    replaced("turned", "(TransformMatrix = )1 0", "$010 1", "TransformMatrix"),
    replaced("dimensions", "(NDims = )3", "$012", "dimensions"),
    replaced("no offset", "(Offset = )0", "$01nan", "Offset"), foreign(offText(), kKind) };
  std::vector<Fault> ofData = header;
  ofData.push_back({ "checksum",
    [=](const std::string& whole, Random& random) -> std::optional<std::string>
    {
      if (whole != compressed)
      {
        return std::nullopt;
      }
      std::string text = whole;
      std::uniform_int_distribution<std::size_t> position(whole.size() - 4, whole.size() - 1);
      text[position(random)] ^= 1;
      return text;
    },
    "checksum|compressed data" });
  Fuzzed beside = image("ball.mhd", { metaHeader("", "voxels.raw") }, header);
  beside.read = [](const std::filesystem::path& file)
  {
    const std::filesystem::path voxels = file.parent_path() / "voxels.raw";
    if (!std::filesystem::exists(voxels))
    {
      std::ofstream(voxels, std::ios::binary) << voxelBytes();
    }
    return readImageBytes(file);
  };
  beside.faults.push_back(replaced("name", "(ElementDataFile = )voxels", "$1pixels", "beside"));
  return { image("ball.mha", { raw, compressed }, ofData), beside };
}

std::vector<Fuzzed> nrrdKinds()
{
  const auto header = [](const std::string& encoding)
  {
    return "NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 10 10 10\n"
           "space directions: (5,0,0) (0,5,0) (0,0,6)\nkinds: domain domain domain\n"
           "endian: little\nencoding: " +
      encoding + "\nspace origin: (0,0,0)\n\n";
  };
  return { image("ball.nrrd",
    { header("raw") + voxelBytes(), header("gzip") + zipped(voxelBytes()) },
    { cutOff(kCut, 10), replaced("size", "(sizes: )[0-9]+", "$01999", kCount),
      replaced("no size", "(sizes: )[0-9]+", "$01-1", "sizes"),
      replaced("type", "float", "real", "type"), replaced("axes", "(\\()5,0", "$010,5", "space"),
      replaced("dimension", "(dimension: )3", "$014", "dimension"),
      replaced("space", "left-post", "up-post", "space"),
      replaced("origin", "(origin: \\()0", "$01nan", "origin"),
      replaced("end", "little", "middle", "endian"), foreign(offText(), kKind) }) };
}

// what is taken of organs
void takeOrgans(const std::string& bytes)
{
  const auto organs = unpackOrgans(bytes);
  if (!organs || organs->organs.empty())
  {
    throw std::runtime_error("the answer of the reader is damaged");
  }
  for (const FileOrgan& organ : organs->organs)
  {
    (void)madeReady(organ.surface, "organs", LengthUnit::Millimeter);
  }
}

// segments in two layers, each taken as an organ
std::vector<Fuzzed> segmentKinds()
{
  std::string voxels;
  const auto data = ballImage();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double distance = data->GetPointData()->GetScalars()->GetComponent(i, 0);
    voxels += distance < 0.0 ? '\1' : '\0';
    voxels += distance < -5.0 ? '\2' : '\0';
  }
  const std::string header =
    "NRRD0005\ntype: uchar\ndimension: 4\nspace: left-posterior-superior\nsizes: 2 10 10 10\n"
    "space directions: none (5,0,0) (0,5,0) (0,0,6)\nencoding: raw\nspace origin: (0,0,0)\n"
    "Segment0_Name:=liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
    "Segment1_Name:=tumor\nSegment1_LabelValue:=2\nSegment1_Layer:=1\n\n";
  Fuzzed kind = image("ball.seg.nrrd", { header + voxels },
    { cutOff(kCut, 10), replaced("layers", "(sizes: )2", "$013", kCount),
      replaced("no layer", "none", "(1,0,0)", "axes|space"),
      replaced("value", "(LabelValue:=)1", "$017", "label"), foreign(offText(), kKind) });
  kind.read = [](const std::filesystem::path& file) {
    return pack(readOrgans(file, { .labels = { "liver", "tumor" } }, {}));
  };
  kind.take = takeOrgans;
  return { kind };
}

std::vector<Fuzzed> otherImages()
{
  const auto data = ballImage();
  const auto vti = [&](auto set) { return written<vtkXMLImageDataWriter>("a.vti", *data, set); };
  const std::string nifti = written<vtkNIFTIImageWriter>("a.nii", *data, [](auto&) {});
  const std::vector<Fault> ofNifti{ cutOff(kCut, 10),
    overwritten("size", 42, 2, 3, bytesOf(std::int16_t{ 999 }), kCount),
    overwritten("negative size", 42, 2, 3, bytesOf(std::int16_t{ -5 }), kCount),
    overwritten("type", 70, 2, 1, bytesOf(std::int16_t{ 999 }), "datatype"),
    overwritten("magic", 344, 4, 1, "abcd", "NIfTI"), foreign(offText(), "NIfTI") };
  Fuzzed packed = image("ball.nii.gz", { nifti }, ofNifti);
  packed.pack = zipped;
  packed.faults.front().packed = true; // cut as it is stored
  packed.faults.push_back({ "checksum",
    [](const std::string& whole, Random& random)
    {
      std::string text = whole;
      // the checksum itself: a bit before it may be one that changes no voxel
      std::uniform_int_distribution<std::size_t> position(whole.size() - 8, whole.size() - 5);
      text[position(random)] ^= 1;
      return std::optional(text);
    },
    "checksum|compressed", true, true });
  return { image("ball.nii", { nifti }, ofNifti), packed,
    image("ball.vti",
      { vti([](auto& w) { w.SetDataModeToAscii(); }), vti([](auto& w) { w.SetDataModeToBinary(); }),
        vti([](auto& w) { w.SetDataModeToAppended(); }) },
      { cutOff(kCut, 40), replaced("extent", "(WholeExtent=\"0 )9", "$0199", "xtent"),
        replaced("type", "type=\"Float32\"", "type=\"Real32\"", "type|Real"),
        replaced("tag", "</PointData>", "</PintData>", "tag|XML|mismatch"),
        replaced("kind", "type=\"ImageData\"", "type=\"PolyData\"", "ImageData|not a VTI", false),
        foreign(offText(), kKind) }) };
}

constexpr DicomReaders kDicom{ .series = readDicom, .segments = readDicomSegments };

std::vector<Fuzzed> dicomSegmentKinds()
{
  const TemporaryFolder folder;
  Fuzzed kind = image("segments.dcm", { readAll(writeSegmentation(folder.path())) },
    { cutOff(kCut + "|damaged|bytes|places", 600),
      replaced("class", "1\\.66\\.4", "1.66.5", "no binary segmentation", false),
      replaced("kind", "BINARY", "OTHERS", "no BINARY"),
      replaced("place", "-3[0-9]", "-3x", "Position"), foreign(offText(), "DICOM") });
  kind.read = [](const std::filesystem::path& file)
  { return pack(readOrgans(file, {}, {}, kDicom)); };
  kind.take = takeOrgans;
  return { kind };
}

// one image of a series, the others beside it
std::vector<Fuzzed> dicomKinds()
{
  const DicomGrid grid{ 16, 16, 4, { -20.0, -20.0, 300.0 }, Eigen::Vector3d::UnitX(),
    Eigen::Vector3d::UnitY(), 2.5, 2.5, 8.0 };
  std::vector<std::string> others;
  std::vector<std::string> whole;
  for (const char* options : { "--write-xfer-little", "--write-xfer-implicit", "dcmcrle" })
  {
    const TemporaryFolder folder;
    writeDicom(folder.path(), "series", grid, options);
    const auto slice = [&](const char* name) { return readAll(folder.path() / "series" / name); };
    whole.push_back(slice("series1_17.dcm"));
    others = { slice("series1_3.dcm"), slice("series1_10.dcm"), slice("series1_24.dcm") };
  }
  const std::string missing = "missing|one place|apart|damaged";
  Fuzzed kind = image("ball.dcm", whole,
    { cutOff("cut off|damaged", 400), replaced("position", R"(-20\\-20)", R"(-2x\-20)", "Position"),
      replaced("place", "316", "308", missing),
      replaced("rows", R"(2\.5\\2\.5)", R"(2.5\3.5)", "spacing"),
      replaced("no spacing", R"(2\.5\\2\.5)", R"(2.5\0.0)", "Spacing"),
      replaced("direction", R"(1\\0\\0)", R"(1\1\0)", "Orientation"),
      replaced("series", R"(1\.2\.3\.1(?!\.))", "1.2.3.2", "has 2 series"),
      replaced("magic", "DICM", "DICE", missing), foreign(offText(), missing) });
  kind.read = [=](const std::filesystem::path& file)
  {
    const std::filesystem::path folder = file.string() + ".series";
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < others.size(); ++i)
    {
      std::ofstream(folder / std::to_string(i), std::ios::binary) << others[i];
    }
    std::filesystem::copy(
      file, folder / "damaged", std::filesystem::copy_options::overwrite_existing);
    return pack(readFile(folder, { .level = kDicomLevel }, kDicom));
  };
  return { kind };
}

} // namespace

std::vector<FuzzedGroup> fuzzedImages()
{
  return { { { "ball.mha", "ball.mhd" }, metaKinds }, { { "ball.nrrd" }, nrrdKinds },
    { { "ball.seg.nrrd" }, segmentKinds }, { { "segments.dcm" }, dicomSegmentKinds },
    { { "ball.dcm" }, dicomKinds }, { { "ball.nii", "ball.nii.gz", "ball.vti" }, otherImages } };
}

} // namespace palp::test
