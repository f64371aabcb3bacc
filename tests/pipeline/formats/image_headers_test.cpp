#include "tests/pipeline/formats/ball_images.h"

#include <algorithm>
#include <tuple>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkXMLImageDataWriter.h>
#include <zlib.h>

namespace palp::test
{
namespace
{

std::string voxelsOf(vtkImageData& image)
{
  vtkDataArray& voxels = *image.GetPointData()->GetScalars();
  return { static_cast<const char*>(voxels.GetVoidPointer(0)),
    static_cast<std::size_t>(voxels.GetNumberOfTuples() * voxels.GetDataTypeSize()) };
}

// by hand: a header of MetaImage with more lines
std::string meta(const std::string& more, const std::string& data = "LOCAL",
  const std::string& spacing = "ElementSpacing = 2 2.5 3\n")
{
  return "ObjectType = Image\nNDims = 3\nDimSize = 41 41 31\n" + spacing + more +
    "ElementType = MET_FLOAT\nElementDataFile = " + data + "\n";
}

TEST_F(Images, MetaImageDataMayBeNamedAsInThisFolder)
{
  (void)write("here.raw", voxelsOf(*ball(false)));
  const auto file = write("here.mhd", meta("", "./here.raw"));
  EXPECT_TRUE(readSurface(file, LengthUnit::Millimeter, { 0.0, {} }).closed);
}

TEST_F(Images, MetaImageValuesAreScaledAsTheHeaderSays)
{
  // the ball's surface, where the distance is 0, has the value slope * 0 - 1000
  for (const char* slope :
    { "", "ElementToIntensityFunctionSlope = 2\n", "ElementToIntensityFunctionSlope = -2\n" })
  {
    const auto file = write("scaled.mha",
      meta(slope + std::string("ElementToIntensityFunctionOffset = -1000\n")) +
        voxelsOf(*ball(false)));
    const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter, { -1000.0, {} });
    EXPECT_LT(farthest(*surface.mesh, kCenterMm), 0.2) << slope;
    EXPECT_GT(volumeMm3(*surface.mesh), 0.0) << slope; // turned outwards
    EXPECT_NE(refusal(file, { 5000.0, {} }).find("its values go from -"), std::string::npos);
  }
  for (const char* slope : { "0", "nan", "1 2", "two" })
  {
    const auto file = write("wrong.mha",
      meta("ElementToIntensityFunctionSlope = " + std::string(slope) + "\n") +
        voxelsOf(*ball(false)));
    EXPECT_NE(refusal(file, { 0.0, {} }).find("ElementToIntensityFunctionSlope"), std::string::npos)
      << slope;
  }
}

// which few files name; a body of 30 mm could be one of 300 mm in cm
TEST_F(Images, MetaImageIsTakenInTheUnitThatItNames)
{
  const std::string voxels = voxelsOf(*ball(false));
  const auto unit = [&](const std::string& name, const std::string& spacing)
  {
    return write("unit.mha",
      meta(name.empty() ? "" : "DistanceUnits = " + name + "\n", "LOCAL",
        "ElementSpacing = " + spacing + "\n") +
        voxels);
  };
  for (const auto& [name, spacing] :
    { std::pair("um", "2000 2500 3000"), { "mm", "2 2.5 3" }, { "cm", "0.2 0.25 0.3" } })
  {
    const LoadedSurface surface = readSurface(unit(name, spacing), {}, { 0.0, {} });
    EXPECT_LT(farthest(*surface.mesh, kCenterMm), 0.2) << name;
    EXPECT_NE(surface.notes[0].find(std::string("taken in ") + name + ", as the file says"),
      std::string::npos);
  }
  const LoadedSurface guessed = readSurface(unit("", "0.002 0.0025 0.003"), {}, { 0.0, {} });
  EXPECT_LT(farthest(*guessed.mesh, kCenterMm), 0.2);
  EXPECT_NE(guessed.notes[0].find("taken in m, a guess"), std::string::npos);
  for (const auto& [name, spacing, words] :
    { std::tuple("", "1 1.25 1.5", "more than one unit"), { "?", "1 1.25 1.5", "more than one" },
      { "", "2000 2500 3000", "no unit" }, { "inch", "2 2.5 3", "DistanceUnits is 'inch'" } })
  {
    const std::string message = refusal(unit(name, spacing), { 0.0, {} });
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
}

TEST_F(Images, MetaImageHeadersAreRefusedByTheKeyThatIsWrong)
{
  const std::string voxels = voxelsOf(*ball(false));
  EXPECT_NE(
    refusal(write("a.mha", meta("", "LOCAL", "") + voxels), { 0.0, {} }).find("no ElementSpacing"),
    std::string::npos);
  for (const char* twice : { "ElementSpacing = 4 4 4\n", "DimSize: 41 41 31\n" })
  {
    const std::string message = refusal(write("b.mha", meta(twice) + voxels), { 0.0, {} });
    const std::string key = std::string(twice).substr(0, std::string(twice).find_first_of(" :"));
    EXPECT_NE(message.find("gives '" + key + "' twice"), std::string::npos) << message;
  }
}

TEST_F(Images, MetaImageWithMoreVoxelsThanItClaimsIsRefusedWithBothSizes)
{
  const std::string voxels = voxelsOf(*ball(false));
  const std::string more(100, '\0');
  const std::string sizes =
    std::to_string(voxels.size() + 100) + " bytes, more than the " + std::to_string(voxels.size());
  write("voxels.raw", more + voxels);
  for (const auto& file :
    { write("a.mha", meta("") + voxels + more), write("a.mhd", meta("", "voxels.raw")) })
  {
    const std::string message = refusal(file, { 0.0, {} });
    EXPECT_NE(message.find(sizes), std::string::npos) << message;
    EXPECT_NE(message.find("HeaderSize"), std::string::npos) << message;
  }
  for (const char* size : { "HeaderSize = 100\n", "HeaderSize = -1\n" }) // -1: at the end
  {
    const auto file = write("b.mhd", meta(size, "voxels.raw"));
    const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter, { 0.0, {} });
    EXPECT_LT(farthest(*surface.mesh, kCenterMm), 0.2) << size;
  }

  std::string packed(compressBound(voxels.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
    reinterpret_cast<const Bytef*>(voxels.data()), voxels.size());
  packed.resize(size);
  const std::string pack = "CompressedData = True\n";
  const std::string known = "CompressedDataSize = " + std::to_string(size) + "\n";
  EXPECT_EQ(refusal(write("c.mha", meta(pack + known) + packed), { 0.0, {} }), "accepted");
  EXPECT_NE(refusal(write("c.mha", meta(pack + known) + packed + more), { 0.0, {} })
              .find(std::to_string(size + 100) + " bytes, more than the " + std::to_string(size)),
    std::string::npos);
  EXPECT_NE(refusal(write("c.mha", meta(pack) + packed + more), { 0.0, {} }).find("more follows"),
    std::string::npos);
  std::string words;
  for (int i = 0; i < 41 * 41 * 31 + 1; ++i)
  {
    words += "1 ";
  }
  EXPECT_NE(refusal(write("d.mha", meta("BinaryData = False\n") + words), { 0.0, {} })
              .find("more than the 52111 voxels"), // 41 * 41 * 31
    std::string::npos);
}

TEST_F(Images, MetaImageIsReadWithOrWithoutBlanksAndPacked)
{
  const auto image = ball(false);
  const std::string voxels(static_cast<const char*>(image->GetScalarPointer()),
    4 * static_cast<std::size_t>(image->GetNumberOfPoints()));
  std::string packed(compressBound(voxels.size()), '\0');
  uLongf size = packed.size();
  ASSERT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
              reinterpret_cast<const Bytef*>(voxels.data()), voxels.size()),
    Z_OK);
  packed.resize(size);
  const std::string head =
    "NDims=3\nDimSize=41 41 31\nElementSpacing=2 2.5 3\n"
    "ElementType=MET_FLOAT\nTransformMatrix=1.000000001 0 0 0 1 0 1e-17 0 1\n";
  const std::string pack = "CompressedData=True\n";
  const std::string tail = "ElementDataFile=LOCAL\n";
  for (const std::string& bytes : { head + tail + voxels, head + pack + tail + packed })
  {
    const auto file = write("a.mha", bytes);
    EXPECT_LT(
      farthest(*readSurface(file, LengthUnit::Millimeter, { 0.0, {} }).mesh, kCenterMm), 0.2);
  }

  const auto words = [&](const std::string& data) {
    return refusal(write("b.mha", head + pack + tail + data), { 0.0, {} });
  };
  EXPECT_NE(words(packed.substr(0, size / 2)).find("cut off"), std::string::npos);
  std::string half(size, '\0');
  uLongf less = size;
  compress(reinterpret_cast<Bytef*>(half.data()), &less,
    reinterpret_cast<const Bytef*>(voxels.data()), voxels.size() / 2);
  EXPECT_NE(words(half.substr(0, less)).find("cut off, its data have"), std::string::npos);
  for (std::size_t i = 10; i < size; i += size / 40)
  {
    std::string damaged = packed;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    EXPECT_NE(words(damaged), "accepted") << i;
  }
  EXPECT_NE(refusal(write("c.mha", "NDims = 99999999\n" + tail), { 0.0, {} })
              .find("not a volume of three dimensions"),
    std::string::npos);
}

// as ITK, and with it SimpleITK and 3D Slicer, writes it
TEST_F(Images, MetaImageAsItkWritesItIsRead)
{
  const auto file = write("itk.mha",
    "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
    "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 10 20 -30\n"
    "CenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\nElementSpacing = 2 2.5 3\n"
    "ITK_InputFilterName = NrrdImageIO\nDimSize = 41 41 31\nElementType = MET_FLOAT\n"
    "ElementDataFile = LOCAL\n" +
      voxelsOf(*ball(false)));
  const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter, { 0.0, {} });
  EXPECT_LT(farthest(*surface.mesh, kCenterMm + Eigen::Vector3d(10, 20, -30)), 0.2);
}

// ITK writes from where the axes come, others to where they go, and all take the matrix
TEST_F(Images, MetaImageWhoseLettersContradictItsMatrixSaysSo)
{
  const std::string voxels = voxelsOf(*ball(false));
  const auto contradicts = [&](const std::string& letters, const std::string& matrix)
  {
    const auto file = write("letters.mha",
      meta("TransformMatrix = " + matrix + "\nAnatomicalOrientation = " + letters + "\n") + voxels);
    const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter, { 0.0, {} });
    const std::string words = "warning: letters.mha: its AnatomicalOrientation, " + letters +
      ", contradicts its TransformMatrix; the matrix is taken";
    return std::ranges::any_of(
      surface.notes, [&](const std::string& note) { return note.starts_with(words); });
  };
  const std::string straight = "1 0 0 0 1 0 0 0 1";
  for (const char* letters : { "RAI", "LPS", "???", "none", "RA" })
  {
    EXPECT_FALSE(contradicts(letters, straight)) << letters;
  }
  for (const char* letters : { "RAS", "LPI", "RIA", "RPI" })
  {
    EXPECT_TRUE(contradicts(letters, straight)) << letters;
  }
  const std::string sagittal = "0 1 0 0 0 -1 -1 0 0"; // to the back, down, to the right
  EXPECT_FALSE(contradicts("ASL", sagittal));
  EXPECT_FALSE(contradicts("PIR", sagittal));
  EXPECT_TRUE(contradicts("RAI", sagittal));
  EXPECT_FALSE(contradicts("RAI", "0.6 0.8 0 -0.8 0.6 0 0 0 1")); // oblique
}

TEST_F(Images, VtiIsTakenByItsOneArrayAndRefusedByWhatItHasInstead)
{
  const auto image = ball(false);
  vtkPointData& points = *image->GetPointData();
  points.GetScalars()->SetName("distance");
  points.SetActiveScalars(nullptr);
  const auto one = write<vtkXMLImageDataWriter>("one.vti", *image);
  const LoadedSurface surface = readSurface(one, LengthUnit::Millimeter, { 0.0, {} });
  EXPECT_LT(farthest(*surface.mesh, kCenterMm), 0.2);

  vtkNew<vtkDoubleArray> other;
  other->SetName("other");
  other->SetNumberOfTuples(image->GetNumberOfPoints());
  other->Fill(0.0);
  points.AddArray(other);
  EXPECT_NE(refusal(write<vtkXMLImageDataWriter>("two.vti", *image), { 0.0, {} })
              .find("2 arrays at its points, as 'distance' and 'other'"),
    std::string::npos);
  points.SetActiveScalars("distance");
  const auto two = write<vtkXMLImageDataWriter>("two.vti", *image);
  EXPECT_LT(farthest(*readSurface(two, LengthUnit::Millimeter, { 0.0, {} }).mesh, kCenterMm), 0.2);

  points.Initialize();
  EXPECT_NE(refusal(write<vtkXMLImageDataWriter>("none.vti", *image), { 0.0, {} })
              .find("no values at its points"),
    std::string::npos);
  other->SetNumberOfTuples(image->GetNumberOfCells());
  image->GetCellData()->AddArray(other);
  EXPECT_NE(refusal(write<vtkXMLImageDataWriter>("cells.vti", *image), { 0.0, {} })
              .find("those of cells, not of points"),
    std::string::npos);
}

// of every encoding, in one piece
TEST_F(Images, VtiWithMoreValuesThanPointsIsRefused)
{
  const auto image = ball(false);
  using Writer = vtkXMLImageDataWriter;
  for (const int mode : { Writer::Ascii, Writer::Binary, Writer::Appended })
  {
    for (const bool packed : { false, true })
    {
      vtkNew<Writer> writer;
      writer->SetDataMode(mode);
      writer->SetCompressorTypeToNone();
      if (packed)
      {
        writer->SetCompressorTypeToZLib();
      }
      writer->SetFileName((folder_.path() / "more.vti").c_str());
      writer->SetInputData(image);
      writer->Write();
      EXPECT_EQ(refusal(folder_.path() / "more.vti", { 0.0, {} }), "accepted") << mode << packed;
      std::string text = readAll(folder_.path() / "more.vti");
      for (std::size_t at = 0; (at = text.find("0 40 0 40", at)) != std::string::npos;)
      {
        text.replace(at, 9, "0 39 0 40");
      }
      const std::string told = refusal(write("more.vti", text), { 0.0, {} });
      EXPECT_NE(told.find("has more values than its extent has points"), std::string::npos)
        << mode << packed << told;
    }
  }
}

} // namespace
} // namespace palp::test
