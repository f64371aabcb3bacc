#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/process.h"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMetaImageWriter.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataWriter.h>
#include <zlib.h>

namespace palp::test
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kRadiusMm = 30.0;
const Vector3d kCenterMm(40.0, 50.0, 45.0);

// distance to a ball [mm], or 1 inside it and 0 outside; voxels of 2 x 2.5 x 3 mm
vtkSmartPointer<vtkImageData> ball(bool mask)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(41, 41, 31);
  image->SetSpacing(2.0, 2.5, 3.0);
  image->AllocateScalars(mask ? VTK_UNSIGNED_CHAR : VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double distance = (Vector3d(image->GetPoint(i)) - kCenterMm).norm() - kRadiusMm;
    image->GetPointData()->GetScalars()->SetComponent(
      i, 0, mask ? (distance < 0.0 ? 1.0 : 0.0) : distance);
  }
  return image;
}

class Images : public testing::Test
{
protected:
  template <typename Writer>
  std::filesystem::path write(const std::string& name, vtkImageData& image, vtkMatrix4x4* form = {})
  {
    const std::filesystem::path file = folder_.path() / name;
    vtkNew<Writer> writer;
    if constexpr (std::is_same_v<Writer, vtkMetaImageWriter>)
    {
      writer->SetCompression(false);
    }
    if constexpr (std::is_same_v<Writer, vtkNIFTIImageWriter>)
    {
      writer->SetQFormMatrix(form);
      writer->SetSFormMatrix(form);
    }
    writer->SetFileName(file.c_str());
    writer->SetInputData(&image);
    writer->Write();
    return file;
  }

  std::string refusal(const std::filesystem::path& file, const ImagePart& part)
  {
    try
    {
      (void)readSurface(file, {}, part);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path write(const std::string& name, const std::string& bytes)
  {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  TemporaryFolder folder_;
};

// largest distance from the ball's surface [mm]
double farthest(vtkPolyData& mesh, const Vector3d& centerMm)
{
  double most = 0.0;
  for (const Vector3d& point : pointsOf(mesh))
  {
    most = std::max(most, std::abs((point * 1e3 - centerMm).norm() - kRadiusMm));
  }
  return most;
}

// volume by the divergence theorem [mm^3]
double volumeMm3(vtkPolyData& mesh)
{
  const std::vector<Vector3d> points = pointsOf(mesh);
  double sum = 0.0;
  for (const Triangle& t : trianglesOf(mesh))
  {
    const auto at = [&](int k) -> const Vector3d&
    { return points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    sum += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return sum * 1e9;
}

TEST_F(Images, TheLevelOfADistanceIsTheBall)
{
  const auto image = ball(false);
  for (const auto& file : { write<vtkMetaImageWriter>("ball.mha", *image),
         write<vtkXMLImageDataWriter>("ball.vti", *image) })
  {
    const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter, { 0.0, {} });
    EXPECT_TRUE(surface.closed) << file;
    EXPECT_EQ(surface.unit, LengthUnit::Millimeter);
    EXPECT_LT(farthest(*surface.mesh, kCenterMm), 0.2) << file; // a tenth of a voxel
  }
}

TEST_F(Images, AMaskLosesItsStairsAndKeepsItsVolume)
{
  const auto file = write<vtkMetaImageWriter>("mask.mha", *ball(true));
  const LoadedSurface surface = readSurface(file, {}, { 0.5, {} });
  EXPECT_TRUE(surface.closed);
  EXPECT_LT(farthest(*surface.mesh, kCenterMm), 2.2); // half the diagonal of a voxel
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadiusMm, 3);
  EXPECT_NEAR(volumeMm3(*surface.mesh), exact, 0.02 * exact);
}

TEST_F(Images, NiftiStandsWhereItsHeaderSaysInAxesToLeftBackAndHead)
{
  // a quarter turn about the head's axis, and a shift, into right, front, head
  vtkNew<vtkMatrix4x4> form;
  const double values[16] = { 0, -1, 0, 7, 1, 0, 0, -9, 0, 0, 1, 11, 0, 0, 0, 1 };
  form->DeepCopy(values);
  const auto file = write<vtkNIFTIImageWriter>("ball.nii.gz", *ball(false), form);
  const LoadedSurface surface = readSurface(file, {}, { 0.0, {} });
  const Vector3d ras(-kCenterMm.y() + 7, kCenterMm.x() - 9, kCenterMm.z() + 11);
  EXPECT_LT(farthest(*surface.mesh, { -ras.x(), -ras.y(), ras.z() }), 0.2);
  EXPECT_GT(volumeMm3(*surface.mesh), 0.0); // turned outwards
}

TEST_F(Images, OnlyTheLargestPieceIsTaken)
{
  const auto image = ball(true);
  image->SetScalarComponentFromDouble(1, 1, 1, 0, 1.0);
  const LoadedSurface surface =
    readSurface(write<vtkMetaImageWriter>("speck.mha", *image), {}, { 0.5, {} });
  EXPECT_LT(farthest(*surface.mesh, kCenterMm), 2.2);
}

TEST_F(Images, RefusesWithTheValuesThatThereAre)
{
  const auto mask = write<vtkMetaImageWriter>("mask.mha", *ball(true));
  EXPECT_NE(refusal(mask, {}).find("name the value of the surface with a level, its values go from "
                                   "0 to 1"),
    std::string::npos);
  EXPECT_NE(refusal(mask, { 3.0, {} }).find("no surface at level 3"), std::string::npos);
  const std::filesystem::path stl = folder_.path() / "a.stl";
  std::ofstream(stl) << "solid a\nendsolid a\n";
  EXPECT_NE(refusal(stl, { 1.0, {} }).find("leave the level out"), std::string::npos);

  std::string turned = readAll(mask);
  const std::string axes = "TransformMatrix = 1 0 0 0 1 0 0 0 1";
  const std::size_t at = turned.find(axes);
  ASSERT_NE(at, std::string::npos);
  turned.replace(at, axes.size(), "TransformMatrix = 0 1 0 1 0 0 0 0 1");
  const std::filesystem::path file = folder_.path() / "turned.mha";
  std::ofstream(file, std::ios::binary) << turned;
  EXPECT_NE(refusal(file, { 0.5, {} }).find("its axes are turned"), std::string::npos);
}

// by hand, as the standard lays it out: 348 bytes, 4 of extension, voxels
std::string nifti(vtkImageData& image, float slope, float intercept, char unit, short volumes = 1)
{
  std::string bytes(352, '\0');
  const auto put = [&](std::size_t at, const auto& value)
  { std::memcpy(bytes.data() + at, &value, sizeof value); };
  put(0, std::int32_t{ 348 });
  const int* size = image.GetDimensions();
  const std::array<short, 5> dim{ static_cast<short>(volumes > 1 ? 4 : 3),
    static_cast<short>(size[0]), static_cast<short>(size[1]), static_cast<short>(size[2]),
    volumes };
  put(40, dim);
  put(70, short{ 16 }); // float
  put(72, short{ 32 });
  std::array<float, 4> pixdim{ 1.0F };
  std::copy_n(image.GetSpacing(), 3, pixdim.begin() + 1);
  put(76, pixdim);
  put(108, 352.0F);
  put(112, slope);
  put(116, intercept);
  bytes[123] = unit;
  put(254, short{ 1 }); // sform
  for (std::size_t row = 0; row < 3; ++row)
  {
    put(280 + 20 * row, pixdim[row + 1]);
  }
  std::memcpy(bytes.data() + 344, "n+1", 4);
  const auto count = static_cast<std::size_t>(image.GetNumberOfPoints());
  const std::string voxels(static_cast<const char*>(image.GetScalarPointer()), 4 * count);
  for (short i = 0; i < volumes; ++i)
  {
    bytes += voxels;
  }
  return bytes;
}

TEST_F(Images, NiftiValuesAreScaledAsTheHeaderSays)
{
  // the ball's surface, where the distance is 0, has the value 2 * 0 - 1000
  for (const float slope : { 2.0F, -2.0F })
  {
    const auto file = write("slope.nii", nifti(*ball(false), slope, -1000.0F, 2));
    const LoadedSurface surface = readSurface(file, {}, { -1000.0, {} });
    EXPECT_LT(farthest(*surface.mesh, { -kCenterMm.x(), -kCenterMm.y(), kCenterMm.z() }), 0.2);
    EXPECT_NE(refusal(file, { 5000.0, {} }).find("its values go from -"), std::string::npos);
  }
  // a slope of 0 means none
  const auto file = write("none.nii", nifti(*ball(false), 0.0F, 7.0F, 2));
  EXPECT_LT(farthest(*readSurface(file, {}, { 0.0, {} }).mesh,
              { -kCenterMm.x(), -kCenterMm.y(), kCenterMm.z() }),
    0.2);
}

// the first axis along the sum of the others, along none, not a number
TEST_F(Images, NiftiAxesThatDoNotSpanSpaceAreRefused)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::array<float, 3>& row :
    { std::array{ 0.0F, 2.5F, 3.0F }, { 0.0F, 0.0F, 0.0F }, { nan, 0.0F, 0.0F } })
  {
    std::string bytes = nifti(*ball(false), 1.0F, 0.0F, 2);
    std::memcpy(bytes.data() + 280, row.data(), sizeof row);
    const auto file = write("flat.nii", bytes);
    EXPECT_NE(refusal(file, { 0.0, {} }).find("do not span space"), std::string::npos);
  }
}

TEST_F(Images, NiftiUnitsAreTurnedIntoMillimeters)
{
  for (const auto& [code, size] : { std::pair('\1', 1e-3), { '\2', 1.0 }, { '\3', 1e3 } })
  {
    const auto image = ball(false);
    image->SetSpacing(2.0 * size, 2.5 * size, 3.0 * size);
    const auto file = write("unit.nii", nifti(*image, 1.0F, 0.0F, code));
    const LoadedSurface surface = readSurface(file, {}, { 0.0, {} });
    EXPECT_LT(farthest(*surface.mesh, { -kCenterMm.x(), -kCenterMm.y(), kCenterMm.z() }), 0.2)
      << int{ code };
  }
}

TEST_F(Images, SaysTheFrameAndWhatWasLeftOut)
{
  const auto file = write("four.nii", nifti(*ball(false), 1.0F, 0.0F, 0, 3));
  const LoadedSurface surface = readSurface(file, {}, { 0.0, {} });
  std::string all;
  for (const std::string& note : surface.notes)
  {
    all += note + '\n';
  }
  EXPECT_NE(all.find("(LPS), turned from NIfTI's"), std::string::npos) << all;
  EXPECT_NE(all.find("warning: four.nii: the first of 3 volumes is taken"), std::string::npos);
  EXPECT_NE(all.find("warning: four.nii: the header names no unit"), std::string::npos);
}

// a ball of label 5 in a ball of label 2, and a box of label 7
vtkSmartPointer<vtkImageData> labels()
{
  auto image = ball(true);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const Vector3d place(image->GetPoint(i));
    const double distance = (place - kCenterMm).norm();
    const double value = distance < 20.0 ? 2.0
      : distance < kRadiusMm             ? 5.0
      : place.z() > 80.0                 ? 7.0
                                         : 0.0;
    image->GetPointData()->GetScalars()->SetComponent(i, 0, value);
  }
  return image;
}

TEST_F(Images, ALabelMapIsTakenByItsLabelsAndNotByALevel)
{
  const auto file = write<vtkMetaImageWriter>("labels.mha", *labels());
  for (const double level : { 0.5, 4.5, 5.0 })
  {
    EXPECT_NE(refusal(file, { level, {} }).find("its labels are 0, 2, 5, 7"), std::string::npos);
  }
  EXPECT_NE(refusal(file, { {}, { 4.0 } }).find("no label 4 in it"), std::string::npos);
  const LoadedSurface inner = readSurface(file, {}, { {}, { 2.0 } });
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(20.0, 3);
  EXPECT_NEAR(volumeMm3(*inner.mesh), exact, 0.03 * exact);
  const LoadedSurface both = readSurface(file, {}, { {}, { 2.0, 5.0 } });
  EXPECT_TRUE(both.closed);
  EXPECT_LT(farthest(*both.mesh, kCenterMm), 2.2);
}

TEST_F(Images, AMaskHasOneSurfaceWhateverLevelLiesBetween)
{
  const auto image = ball(true);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    auto* voxels = image->GetPointData()->GetScalars();
    voxels->SetComponent(i, 0, 255.0 * voxels->GetComponent(i, 0));
  }
  const auto file = write<vtkMetaImageWriter>("mask.mha", *image);
  const LoadedSurface middle = readSurface(file, {}, { 127.5, {} });
  const LoadedSurface low = readSurface(file, {}, { 0.5, {} });
  EXPECT_EQ(pointsOf(*low.mesh), pointsOf(*middle.mesh));
  EXPECT_NE(low.notes[2].find("its surface is taken at 127.5, their middle"), std::string::npos);
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
    EXPECT_LT(farthest(*readSurface(file, {}, { 0.0, {} }).mesh, kCenterMm), 0.2);
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

TEST_F(Images, ADamagedImageIsRefusedInOneSentence)
{
  const auto image = ball(true);
  for (const auto& whole :
    { write<vtkMetaImageWriter>("a.mha", *image), write<vtkNIFTIImageWriter>("a.nii", *image),
      write<vtkNIFTIImageWriter>("a.nii.gz", *image),
      write<vtkXMLImageDataWriter>("a.vti", *image) })
  {
    const std::string bytes = readAll(whole);
    for (const double part : { 0.01, 0.3, 0.9 })
    {
      const std::filesystem::path cut = folder_.path() / ("cut_" + whole.filename().string());
      std::ofstream(cut, std::ios::binary)
        << bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size())));
      const std::string message = refusal(cut, { 0.5, {} });
      EXPECT_NE(message, "accepted") << cut << ' ' << part;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
}

} // namespace
} // namespace palp::test
