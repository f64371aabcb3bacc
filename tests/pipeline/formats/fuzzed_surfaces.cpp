#include "tests/pipeline/formats/fuzzed_surfaces.h"

#include "data/shapes.h"
#include "haptics/contact/find_contact.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/formats/surface_formats.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMetaImageWriter.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <zlib.h>

namespace palp::test
{
namespace
{

using namespace units::literals;

// ---- files without a fault

template <typename Writer, typename Data, typename Set>
std::string written(const char* name, Data& data, Set set)
{
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / name;
  vtkNew<Writer> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(&data);
  set(*writer);
  writer->Write();
  return readAll(file);
}

Mesh ball()
{
  return makeSphere(50.0, 1); // [mm], as it stands in a file
}

vtkSmartPointer<vtkPolyData> ballData()
{
  return makePolyData(ball().points, ball().triangles);
}

// in text, one point and one triangle in a line
std::string ballText(
  const std::string& head, const std::string& point, const std::string& corner, int first)
{
  std::ostringstream text;
  text << head;
  for (const Eigen::Vector3d& p : ball().points)
  {
    text << point << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  for (const Triangle& t : ball().triangles)
  {
    text << corner << t[0] + first << ' ' << t[1] + first << ' ' << t[2] + first << '\n';
  }
  return text.str();
}

std::string offText()
{
  const Mesh mesh = ball();
  return ballText("OFF\n" + std::to_string(mesh.points.size()) + ' ' +
      std::to_string(mesh.triangles.size()) + " 0\n",
    "", "3 ", 0);
}

std::string vtuText()
{
  return R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="2">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 100 0 0 0 100 0 0 0 100 100 100 100</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 1 2 3 4</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
)";
}

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

std::string voxelBytes()
{
  return { static_cast<const char*>(ballImage()->GetScalarPointer()), kVoxelBytes };
}

std::string deflated(const std::string& bytes, int windowBits)
{
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

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

std::string bytesOf(auto value)
{
  return { reinterpret_cast<const char*>(&value), sizeof value };
}

// ---- how they are read and taken

std::string readSurfaceBytes(const std::filesystem::path& file)
{
  return pack(readFile(file));
}

std::string readImageBytes(const std::filesystem::path& file)
{
  return pack(readFile(file, { .level = 0.0, .labels = {} }));
}

void press(const std::string& bytes, const std::string& name)
{
  const auto read = unpack(bytes);
  if (!read)
  {
    throw std::runtime_error("the answer of the reader is damaged");
  }
  const LoadedSurface loaded = madeReady(*read, name, LengthUnit::Millimeter);
  const Surface surface(pointsOf(*loaded.mesh), trianglesOf(*loaded.mesh));
  for (std::size_t i = 0; i < surface.points().size(); i += 1 + surface.points().size() / 20)
  {
    const Eigen::Vector3d normal = surface.normals()[i];
    const Contact contact = findContact(surface, SphereTip{ 5.0_mm },
      { .apex = surface.points()[i] - 1.0_mm * normal, .axis = -normal }, ContactRule::Exact);
    if (!std::isfinite(contact.depth) || !contact.normal.allFinite() || !contact.center.allFinite())
    {
      throw std::runtime_error("a contact that is not finite");
    }
  }
}

// ---- what may be wrong with them

const std::string kCut = "cut off|ends after|ends in|too short|empty|missing";
const std::string kIndex = "a point that is not there|refers to (vertex|point)";
const std::string kNumber = "usable number|not a number|three coordinates|not numbers";
const std::string kCount = "counts|cut off|holds|ends after|number of|more than|size";
const std::string kKind = "not an? [A-Z]|whatever its name|expected OFF|no triangles|datatype";

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Fuzzed surface(const std::string& file, std::vector<std::string> whole, std::vector<Fault> faults)
{
  return { .file = file,
    .whole = std::move(whole),
    .faults = std::move(faults),
    .read = readSurfaceBytes,
    .take = [file](const std::string& bytes) { press(bytes, file); } };
}

Fuzzed image(const std::string& file, std::vector<std::string> whole, std::vector<Fault> faults)
{
  Fuzzed kind = surface(file, std::move(whole), std::move(faults));
  kind.read = readImageBytes;
  return kind;
}

std::vector<Fuzzed> stlKinds()
{
  const auto data = ballData();
  const std::string text = written<vtkSTLWriter>("a.stl", *data, [](auto&) {});
  const std::string binary =
    written<vtkSTLWriter>("a.stl", *data, [](auto& w) { w.SetFileTypeToBinary(); });
  return { surface("text.stl", { text },
             { cutOff(kCut, 120), replaced("no number", "(vertex )[^ ]*", "$1nan", kNumber),
               replaced("a word for a number", "(vertex )[^ ]*", "$01.2.3", kNumber),
               foreign(offText(), kKind) }),
    surface("binary.stl", { binary },
      { cutOff(kCut, 90), overwritten("NaN", 96, 50, 80, bytesOf(kNan), kNumber),
        overwritten("infinite", 104, 50, 80, bytesOf(1e30F), kNumber),
        overwritten("count", 80, 4, 1, bytesOf(100'000), kCount),
        foreign(voxelBytes(), "not an STL|no STL") }) };
}

std::vector<Fuzzed> textKinds()
{
  const std::string obj = ballText("# a ball\n", "v ", "f ", 1);
  return { surface("ball.obj", { obj },
             { replaced("NaN", "(v )[^ ]*", "$1nan", kNumber),
               replaced("a word", "(v [^ ]* )[^ ]*", "$1x1", kNumber),
               replaced("index", "(f )[0-9]+", "$019999", kIndex),
               replaced("index zero", "(f )[0-9]+", "$010", kIndex + "|counts from 1"),
               replaced("index below", "(f )[0-9]+", "$01-9999", kIndex),
               replaced("a word for a corner", "(f )[0-9]+", "$01x", "corner"),
               foreign(offText(), kKind) }),
    surface("ball.off", { offText() },
      { cutOff(kCut, 20),
        replaced("NaN", "(\n)[^ ]*( [^ ]* [^ ]*\n)", "$1nan$2", kNumber + "|expected"),
        replaced("index", "(\n3 )[0-9]+", "$019999", kIndex),
        replaced("index below", "(\n3 )[0-9]+", "$01-1", kIndex),
        replaced("count", "^(OFF\n)[0-9]+", "$019999", kCount + "|expected"),
        replaced("few points", "^(OFF\n)[0-9]+", "$0140", kIndex + "|expected"),
        replaced("corners", "(\n)3( [0-9]+ [0-9]+ [0-9]+)", "$019$2", "corners"),
        foreign(obj, kKind) }) };
}

std::vector<Fuzzed> plyKinds()
{
  const auto data = ballData();
  const std::string text =
    written<vtkPLYWriter>("a.ply", *data, [](auto& w) { w.SetFileTypeToASCII(); });
  const std::string binary =
    written<vtkPLYWriter>("a.ply", *data, [](auto& w) { w.SetFileTypeToBinary(); });
  const std::size_t begin = binary.find("end_header") + 11;
  const std::size_t faces = begin + 12 * ball().points.size();
  const std::vector<Fault> header{ cutOff(kCut, 10),
    replaced("count of points", "(element vertex )[0-9]+", "$019999", kCount),
    replaced("count of faces", "(element face )[0-9]+", "$019999", kCount),
    replaced("type", "(property )float", "$1real", "property|type|header"),
    replaced("format", "(format )[a-z_]+", "$1asci", "format|header"), foreign(offText(), kKind) };
  std::vector<Fault> ofText = header;
  ofText.push_back(replaced("NaN", "(\n)-?[0-9.]+( -?[0-9.]+ -?[0-9.]+ ?\n)", "$1nan$2", kNumber));
  ofText.push_back(replaced("index", "(\n3 )[0-9]+", "$019999", kIndex));
  ofText.push_back(replaced("index below", "(\n3 )[0-9]+", "$01-1", kIndex));
  ofText.push_back(replaced("corners", "(\n)3( [0-9]+ [0-9]+ [0-9]+)", "$019$2", "corners"));
  std::vector<Fault> ofBinary = header;
  ofBinary.push_back(overwritten("NaN", begin, 12, 42, bytesOf(kNan), kNumber));
  ofBinary.push_back(overwritten("index", faces + 1, 13, 80, bytesOf(9999), kIndex));
  ofBinary.push_back(overwritten("index below", faces + 5, 13, 80, bytesOf(-1), kIndex));
  ofBinary.push_back(overwritten("corners", faces, 13, 80, "\xC8", kCount + "|corners"));
  return { surface("text.ply", { text }, ofText), surface("binary.ply", { binary }, ofBinary) };
}

std::vector<Fuzzed> vtkKinds()
{
  const auto data = ballData();
  const std::string legacy = written<vtkPolyDataWriter>("a.vtk", *data, [](auto&) {});
  const std::string legacyBinary =
    written<vtkPolyDataWriter>("a.vtk", *data, [](auto& w) { w.SetFileTypeToBinary(); });
  const std::string older = ballText(
    "# vtk DataFile Version 3.0\nball\nASCII\nDATASET POLYDATA\nPOINTS 42 float\n", "", "3 ", 0);
  const std::size_t after = older.find("\n3 ") + 1; // no point begins so
  const std::string old = std::string(older).insert(after, "POLYGONS 80 320\n");
  const auto xml = [&](auto set) { return written<vtkXMLPolyDataWriter>("a.vtp", *data, set); };
  const std::string ascii = xml([](auto& w) { w.SetDataModeToAscii(); });
  const std::string index = kIndex + "|connectivity";
  return { surface("ball.vtk", { legacy, legacyBinary, old },
             { cutOff(kCut, 60), replaced("count of points", "(POINTS )[0-9]+", "$019999", kCount),
               replaced("keyword", "DATASET [A-Z]+", "DATASET POLYDOTO", "[Dd]ata ?set|DATASET"),
               replaced("version", "^# vtk", "# vkt", kKind),
               replaced("type", "(POINTS [0-9]+ )[a-z]+", "$1real", "type|real"),
               foreign(offText(), kKind) }),
    surface("ball.vtp",
      { ascii, xml([](auto& w) { w.SetDataModeToBinary(); }),
        xml([](auto& w) { w.SetDataModeToAppended(); }),
        xml([](auto& w) { w.SetCompressorTypeToNone(); }) },
      { cutOff(kCut, 40),
        replaced("count of points", "(NumberOfPoints=\")[0-9]+", "$019999", kCount),
        replaced("count of polygons", "(NumberOfPolys=\")[0-9]+", "$019999", kCount),
        replaced("tag", "</Points>", "</Pints>", "tag|XML|mismatch"),
        replaced(
          "kind", "type=\"PolyData\"", "type=\"UnstructuredGrid\"", "PolyData|not a VTP", false),
        foreign(offText(), kKind) }),
    surface("text.vtp", { ascii },
      { replaced("index", "( )[0-9]+( [0-9]+ [0-9]+ [0-9]+ [0-9]+ [0-9]+\n *[0-9]+ [0-9]+ )",
          "$019999$2", index),
        replaced("NaN", R"((NumberOfComponents="3"[^>]*>\s*)[^ ]+)", "$1nan", kNumber) }),
    surface("tetra.vtu", { vtuText() },
      { cutOff(kCut, 40),
        replaced("count of points", "(NumberOfPoints=\")[0-9]+", "$019999", kCount),
        replaced("count of cells", "(NumberOfCells=\")[0-9]+", "$019999", kCount),
        replaced("index", "2 3 4<", "2 3 9<", index),
        replaced("index below", "2 3 4<", "2 3 -1<", index),
        replaced("NaN", "100 0 0", "100 nan 0", kNumber),
        replaced("tag", "</Points>", "</Pints>", "tag|XML|mismatch"),
        foreign(offText(), kKind) }) };
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
    replaced("turned", "(TransformMatrix = )1 0", "$010 1", "turned"),
    replaced("dimensions", "(NDims = )3", "$012", "dimensions"),
    replaced("no offset", "(Offset = )0", "$01nan", "Offset"), foreign(offText(), kKind) };
  std::vector<Fault> ofData = header;
  const std::size_t begin = compressed.size() - packed.size();
  ofData.push_back({ "checksum",
    [=](const std::string& whole, Random& random) -> std::optional<std::string>
    {
      if (whole != compressed)
      {
        return std::nullopt;
      }
      std::string text = whole;
      std::uniform_int_distribution<std::size_t> place(begin + 2, whole.size() - 5);
      text[place(random)] ^= 1;
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

std::vector<Fuzzed> otherImages()
{
  const auto data = ballImage();
  const auto vti = [&](auto set) { return written<vtkXMLImageDataWriter>("a.vti", *data, set); };
  const std::string nifti = written<vtkNIFTIImageWriter>("a.nii", *data, [](auto&) {});
  const std::vector<Fault> ofNifti{ cutOff(kCut, 10),
    overwritten("size", 42, 2, 3, bytesOf(std::int16_t{ 999 }), kCount),
    overwritten("negative size", 42, 2, 3, bytesOf(std::int16_t{ -5 }), kCount),
    overwritten("type", 70, 2, 1, bytesOf(std::int16_t{ 999 }), "datatype"),
    overwritten("slope", 112, 4, 1, bytesOf(kNan), "scl_slope"),
    overwritten("magic", 344, 4, 1, "abcd", "NIfTI"), foreign(offText(), "NIfTI") };
  Fuzzed packed = image("ball.nii.gz", { nifti }, ofNifti);
  packed.pack = zipped;
  packed.faults.front().packed = true; // cut as it is stored
  packed.faults.push_back({ "checksum",
    [](const std::string& whole, Random& random)
    {
      std::string text = whole;
      std::uniform_int_distribution<std::size_t> place(12, whole.size() - 9);
      text[place(random)] ^= 1;
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

} // namespace

const std::vector<Fuzzed>& fuzzedSurfaces()
{
  static const std::vector<Fuzzed> all = []
  {
    std::vector<Fuzzed> every;
    for (auto* kinds : { stlKinds, textKinds, plyKinds, vtkKinds, metaKinds, otherImages })
    {
      std::ranges::move(kinds(), std::back_inserter(every));
    }
    return every;
  }();
  return all;
}

void fuzzSurface(std::size_t which, int count)
{
  ASSERT_EQ(fuzzedSurfaces().size(), kFuzzedSurfaces);
  const Fuzzed& kind = fuzzedSurfaces()[which];
  const char* asked = std::getenv("PALP_FUZZ");
  constexpr std::size_t memory = 832U << 20; // of palp-read for a small file, and this program
  constexpr double time = 4.0;               // of palp-read for a small file [s]
  expectGoodFates(kind, fuzz(kind, asked ? std::atoi(asked) : count, memory, time));
}

std::string nameOf(const Fuzzed& kind)
{
  std::string name = kind.file;
  std::ranges::replace(name, '.', '_');
  return name;
}

} // namespace palp::test
