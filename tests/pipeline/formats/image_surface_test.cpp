#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/find_contact.h"
#include "haptics/error.h"
#include "haptics/force/force_law.h"
#include "haptics/units.h"
#include "pipeline/formats/regions/image_values.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/process.h"
#include "tests/support/surfaces.h"

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataWriter.h>

namespace palp::test
{
namespace
{

using Eigen::Array3d;
using Eigen::Vector3d;
using namespace units::literals;

constexpr int kSide = 48;     // of each image [voxels]
constexpr double kMid = 23.5; // its center

// what a body is: negative inside [mm], from the center of the image
using Shape = std::function<double(const Vector3d&)>;

vtkSmartPointer<vtkImageData> imageOf(const Shape& distance, const Array3d& spacing, bool mask)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(kSide, kSide, kSide);
  image->SetSpacing(spacing.data());
  image->AllocateScalars(mask ? VTK_UNSIGNED_CHAR : VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double value = distance(Vector3d(image->GetPoint(i)) - Vector3d(spacing * kMid));
    image->GetPointData()->GetScalars()->SetComponent(
      i, 0, mask ? static_cast<double>(value < 0.0) : value);
  }
  return image;
}

class ImageSurface : public testing::Test
{
protected:
  template <typename Writer>
  std::filesystem::path write(const char* name, vtkImageData& image)
  {
    const std::filesystem::path file = folder_.path() / name;
    vtkNew<Writer> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(&image);
    writer->Write();
    return file;
  }

  // points of the surface of a mask, from its center [voxels]
  std::vector<Vector3d> surfaceOfMask(const Shape& distance, const Array3d& spacing)
  {
    const auto file = write<vtkXMLImageDataWriter>("mask.vti", *imageOf(distance, spacing, true));
    surface_ = readSurface(file, LengthUnit::Millimeter, { .level = 0.5, .labels = {} });
    const auto& surface = surface_;
    std::vector<Vector3d> points;
    for (const Vector3d& point : pointsOf(*surface.mesh))
    {
      points.emplace_back((1e3 * point.array() / spacing - kMid).matrix());
    }
    return points;
  }

  std::string refusal(const std::filesystem::path& file)
  {
    try
    {
      (void)readSurface(file, LengthUnit::Millimeter, { .level = 0.0, .labels = {} });
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
  LoadedSurface surface_;
};

Shape blockOf(const Vector3d& half)
{
  return [half](const Vector3d& p) { return (p.cwiseAbs() - half).maxCoeff(); };
}

Shape ballOf(double radius)
{
  return [radius](const Vector3d& p) { return p.norm() - radius; };
}

TEST_F(ImageSurface, OfAMaskStandsWithinHalfAVoxelOfWhereItsVoxelsEnd)
{
  const Array3d spacing(1.0, 2.0, 3.0);
  for (const Vector3d& half : { Vector3d(12, 12, 12), Vector3d(16, 10, 5), Vector3d(14, 12, 2) })
  {
    const Vector3d halfMm = (half.array() * spacing).matrix();
    for (const Vector3d& point : surfaceOfMask(blockOf(halfMm), spacing))
    {
      Vector3d::Index face = 0;
      const double out = (point.cwiseAbs() - half).maxCoeff(&face);
      EXPECT_LT(out, 0.501) << point.transpose();
      EXPECT_GT(out, -1.001) << point.transpose(); // at a corner of the voxels, which is cut
      if ((half - point.cwiseAbs())[(face + 1) % 3] > 1.0 &&
        (half - point.cwiseAbs())[(face + 2) % 3] > 1.0)
      {
        EXPECT_GT(out, -0.501) << point.transpose();
      }
    }
  }
}

TEST_F(ImageSurface, OfAMaskedBallIsTheBall)
{
  for (double radius = 5.0; radius < 21.0; radius += 1.3) // voxels
  {
    const auto points = surfaceOfMask(ballOf(2.0 * radius), Array3d::Constant(2.0));
    double mean = 0.0;
    for (const Vector3d& point : points)
    {
      const double out = point.norm() - radius;
      EXPECT_LT(std::abs(out), 0.6) << "radius " << radius;
      mean += out / static_cast<double>(points.size());
    }
    EXPECT_NEAR(mean, 0.0, 0.12) << "radius " << radius;
  }
}

// terraces of a mask, as wide as the contact where the ball faces along the voxels, are no planes
TEST_F(ImageSurface, OfAMaskedBallAnswersAToolAsTheBall)
{
  const double voxel = 2.0; // [mm]
  const ForceLaw law(SphereTip{ 10.0_mm }, makeMaterial(5.0_kPa, 0.45), { LawMode::Corrected });
  for (const double radius : { 10.3, 16.45 }) // [voxels]
  {
    (void)surfaceOfMask(ballOf(voxel * radius), Array3d::Constant(voxel));
    const Surface masked(pointsOf(*surface_.mesh), trianglesOf(*surface_.mesh));
    const Surface exact = makeSurface(ball(1e-3 * voxel * radius, 40));
    const Vector3d middle = Vector3d::Constant(1e-3 * voxel * kMid);
    for (const double depth : { 2.0_mm, 4.0_mm })
    {
      const auto touch = [&](const Surface& surface, const Vector3d& center, const Vector3d& from)
      {
        const Vector3d apex = center + (1e-3 * voxel * radius - depth) * from;
        return findContact(surface, law.tip(), { .apex = apex, .axis = -from }, ContactRule::Exact);
      };
      for (const Vector3d& toward : { Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(0, 0, 1),
             Vector3d(1, 1, 0), Vector3d(1, -1, 1), Vector3d(1, 2, 3), Vector3d(-5, 1, 0.5) })
      {
        const Vector3d from = toward.normalized();
        const Contact found = touch(masked, middle, from);
        Contact expected = touch(exact, Vector3d::Zero(), from);
        EXPECT_NEAR(found.depth, expected.depth, 0.5e-3 * voxel);
        expected.depth = found.depth; // the mask says no more of where it begins
        EXPECT_NEAR(
          law(contactGeometryOf(found)).force / law(contactGeometryOf(expected)).force, 1.0, 0.1)
          << radius << " voxels, " << depth << " m, from " << toward.transpose() << ", curvature "
          << found.surfaceCurvature << " of " << expected.surfaceCurvature << ", thickness "
          << found.thickness << " of " << expected.thickness;
      }
    }
  }
}

// an atlas of 512 regions, cubes of six voxels; of doubles it fills the last block of its file
TEST_F(ImageSurface, AnyOfManyLabelsIsReadByItsNumber)
{
  constexpr int kCubes = 8; // a side
  constexpr int kCube = 6;  // voxels
  for (const int type : { VTK_SHORT, VTK_INT, VTK_FLOAT, VTK_DOUBLE })
  {
    const auto image = imageOf(ballOf(1.0), Array3d::Ones(), true);
    image->AllocateScalars(type, 1);
    for (int i = 0; i < kSide * kSide * kSide; ++i)
    {
      const Eigen::Array3i voxel(i % kSide, i / kSide % kSide, i / (kSide * kSide));
      const Eigen::Array3i cube = voxel / kCube;
      const int label = cube[0] + kCubes * (cube[1] + kCubes * cube[2]);
      image->GetPointData()->GetScalars()->SetComponent(i, 0, 30.0 * label);
    }
    const auto file = write<vtkXMLImageDataWriter>("atlas.vti", *image);
    for (const int label : { 1, 100, 219, 300, 511 })
    {
      const LoadedSurface one = readSurface(
        file, LengthUnit::Millimeter, { .level = {}, .labels = { std::to_string(30 * label) } });
      const Array3d cube(label % kCubes, label / kCubes % kCubes, label / (kCubes * kCubes));
      Eigen::AlignedBox3d box;
      for (const Vector3d& point : pointsOf(*one.mesh))
      {
        box.extend(1e3 * point);
      }
      const Array3d low = kCube * cube - 0.5;
      const Array3d high = low + kCube;
      constexpr double kHalf = 0.5 + 1e-6; // voxel
      EXPECT_LT((box.min().array() - low).abs().maxCoeff(), kHalf) << label;
      EXPECT_LT((box.max().array() - high).abs().maxCoeff(), kHalf) << label;
      // at the border of the image its sides are flat, and those across alone are round
      const bool isInside = cube.minCoeff() > 0.0 && cube.maxCoeff() < kCubes - 1;
      EXPECT_LT((box.center().array() - 0.5 * (low + high)).abs().maxCoeff(), isInside ? 0.1 : 0.3)
        << label;
    }
  }
}

// a scan's values are as many; neither its air nor what a scanner puts around makes it a map
TEST_F(ImageSurface, AScanIsNoMapOfLabels)
{
  std::mt19937 random(1);
  std::uniform_int_distribution<int> tissue(-100, 900);
  const auto image = imageOf(ballOf(1.0), Array3d::Ones(), true);
  image->AllocateScalars(VTK_SHORT, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double away = (Vector3d(image->GetPoint(i)) - Vector3d::Constant(kMid)).norm();
    image->GetPointData()->GetScalars()->SetComponent(i, 0,
      away > 24.0     ? -2000.0
        : away > 15.0 ? -1024.0
                      : tissue(random));
  }
  const ImageValues values = valuesOf(*image);
  EXPECT_FALSE(values.labels);
  EXPECT_TRUE(values.distinct.empty());
  EXPECT_EQ(values.low, -2000.0);
}

// VTK fills them up with what it has just read
TEST_F(ImageSurface, OfAnArrayCutOffWithinItsFileIsRefused)
{
  const auto image = imageOf(ballOf(30.0), Array3d::Constant(2.0), false);
  const std::filesystem::path file = folder_.path() / "inline.vti";
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(image);
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToNone();
  writer->Write();
  const std::string whole = test::readAll(file);
  EXPECT_EQ(refusal(file), "accepted");
  std::string bits = "<DataArray type=\"Bit\" Name=\"bits\" format=\"ascii\">";
  for (int i = 0; i < kSide * kSide * kSide; ++i)
  {
    bits += " 1";
  }
  std::string more = whole;
  more.insert(whole.find("</PointData>"), bits + "</DataArray>");
  std::ofstream(file, std::ios::binary) << more;
  EXPECT_EQ(refusal(file), "accepted");
  const std::size_t end = whole.find("</DataArray>");
  const std::size_t last = whole.find_last_not_of(" \n", end - 1) + 1;
  for (const double part : { 0.001, 0.1, 0.5, 0.9 })
  {
    const auto less = static_cast<std::size_t>(part * kSide * kSide * kSide) / 4 * 4;
    std::ofstream(file, std::ios::binary) << whole.substr(0, last - less) << whole.substr(last);
    EXPECT_NE(refusal(file).find("cut off"), std::string::npos) << part << refusal(file);
  }
}

TEST_F(ImageSurface, OfVoxelsThatAreNoNumbersIsRefusedByTheirNumberAndPlace)
{
  for (const float odd : { std::numeric_limits<float>::quiet_NaN(),
         std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity() })
  {
    const auto image = imageOf(ballOf(30.0), Array3d::Constant(2.0), false);
    *static_cast<float*>(image->GetScalarPointer(3, 4, 5)) = odd;
    for (const auto& file : { write<vtkXMLImageDataWriter>("odd.vti", *image),
           write<vtkNIFTIImageWriter>("odd.nii", *image) })
    {
      EXPECT_NE(refusal(file).find("no numbers (NaN or infinite): 1, the first at 3, 4, 5 "),
        std::string::npos)
        << refusal(file);
      EXPECT_THROW((void)readFileSurface(file, { .band = { { 0.0, 99.0 } } }), Error);
    }
    *static_cast<float*>(image->GetScalarPointer(9, 4, 5)) = odd;
    EXPECT_NE(refusal(write<vtkXMLImageDataWriter>("odd.vti", *image))
                .find("infinite): 2, the first at 3, 4, 5"),
      std::string::npos);
    // nor is a mask with such a voxel a map of three labels
    const auto mask = imageOf([](const Vector3d& p) { return p.norm() < 30.0 ? -1.0 : 1.0; },
      Array3d::Constant(2.0), false);
    *static_cast<float*>(mask->GetScalarPointer(3, 4, 5)) = odd;
    EXPECT_NE(refusal(write<vtkXMLImageDataWriter>("mask.vti", *mask))
                .find("infinite): 1, the first at 3, 4, 5"),
      std::string::npos);
  }
}

// of all formats: the corner, the size of a voxel
TEST_F(ImageSurface, OfAHeaderWithoutNumbersIsRefusedByWhatIsWrong)
{
  const auto changed =
    [&](const std::filesystem::path& file, const std::string& from, const std::string& to)
  {
    std::string text = readAll(file);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    std::ofstream(file, std::ios::binary) << text.replace(at, from.size(), to);
    return refusal(file);
  };
  const auto image = imageOf(ballOf(30.0), Array3d(2.0, 2.0, 2.0), false);
  const auto vti = [&] { return write<vtkXMLImageDataWriter>("odd.vti", *image); };
  const std::string corner = "the origin in its header is not a number";
  const std::string axes = "the axes in its header do not span space";
  const auto says = [](const std::string& sentence, const std::string& words)
  { EXPECT_NE(sentence.find(words), std::string::npos) << words << ": " << sentence; };
  says(changed(vti(), "Origin=\"0 0", "Origin=\"0 nan"), "its Origin is not 3 numbers");
  says(changed(vti(), "Spacing=\"2 2", "Spacing=\"2 nan"), "its Spacing is not 3 numbers");
  says(changed(vti(), "Spacing=\"2 2", "Spacing=\"2 0"), axes);

  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [at, words] : { std::pair(292, corner), { 308, corner }, { 280, axes } })
  {
    const auto file = write<vtkNIFTIImageWriter>("odd.nii", *image);
    std::string bytes = readAll(file);
    const std::int16_t form = 1;
    std::memcpy(bytes.data() + 254, &form, sizeof form); // sform_code, its rows from 280 on
    for (const int row : { 0, 1, 2 })
    {
      const float one[4] = { row == 0 ? 2.0F : 0.0F, row == 1 ? 2.0F : 0.0F,
        row == 2 ? 2.0F : 0.0F };
      std::memcpy(bytes.data() + 280 + 16 * row, one, sizeof one);
    }
    std::memcpy(bytes.data() + at, &nan, sizeof nan);
    std::ofstream(file, std::ios::binary) << bytes;
    says(refusal(file), words);
  }
}

} // namespace
} // namespace palp::test
