#include "tests/pipeline/formats/ball_images.h"

#include <sstream>
#include <vtkFieldData.h>
#include <vtkMatrix3x3.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataWriter.h>

namespace palp::test
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

class ImageAxes : public Images
{
protected:
  // voxels of a distance, in the order and form of all formats without words
  [[nodiscard]] static std::string voxels()
  {
    const auto image = ball(false);
    return { static_cast<const char*>(image->GetScalarPointer()),
      static_cast<std::size_t>(image->GetNumberOfPoints()) * sizeof(float) };
  }

  [[nodiscard]] static std::string row(const auto& numbers, const char* between)
  {
    std::ostringstream text;
    text.precision(17);
    for (Eigen::Index i = 0; i < numbers.size(); ++i)
    {
      text << (i > 0 ? between : "") << numbers[i];
    }
    return text.str();
  }

  std::filesystem::path meta(const Matrix3d& axes, const std::string& unit = "")
  {
    return write("a.mha",
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
      "TransformMatrix = " +
        row(axes.reshaped(), " ") + "\nOffset = " + row(kOffset, " ") +
        "\nElementSpacing = 2 2.5 3\n" + (unit.empty() ? "" : "DistanceUnits = " + unit + "\n") +
        "DimSize = 41 41 31\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n" + voxels());
  }

  std::filesystem::path nrrd(const std::string& space, const std::string& place)
  {
    return write("a.nrrd",
      "NRRD0005\ntype: float\ndimension: 3\n" + space + "sizes: 41 41 31\n" + place +
        "endian: little\nencoding: raw\n\n" + voxels());
  }

  static void expectBall(const LoadedSurface& surface, const Vector3d& center, double mm)
  {
    EXPECT_TRUE(surface.closed);
    Vector3d low = Vector3d::Constant(1e9);
    Vector3d high = -low;
    for (const Vector3d& point : pointsOf(*surface.mesh))
    {
      low = low.cwiseMin(point * 1e3);
      high = high.cwiseMax(point * 1e3);
    }
    EXPECT_LT((0.5 * (low + high) - mm * center).norm(), 0.1 * mm);
    EXPECT_NEAR((high - low).mean(), mm * 2.0 * kRadiusMm, 0.2 * mm);
    EXPECT_GT(volumeMm3(*surface.mesh), 0.0) << "faces outwards";
  }

  const Vector3d kOffset{ -112.5, 60.25, 801.0 };
};

const Matrix3d kOblique = Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.4).normalized()).matrix();

// the manual of MetaIO: nine numbers, the directions of the first, second and third axis in turn
TEST_F(ImageAxes, OfMetaImageAreTheDirectionsInTurn)
{
  const Matrix3d flipped = Vector3d(-1.0, -1.0, 1.0).asDiagonal();
  const Matrix3d mirrored = Vector3d(1.0, -1.0, 1.0).asDiagonal();
  const Matrix3d swapped{ { 0.0, 1.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  for (const Matrix3d& axes : { flipped, mirrored, swapped, kOblique })
  {
    expectBall(readSurface(meta(axes), LengthUnit::Millimeter, { .level = 0.0 }),
      kOffset + axes * kCenterMm, 1.0);
  }
  Matrix3d flat = kOblique;
  flat.col(1) = flat.col(0);
  for (const Matrix3d& axes : { flat, Matrix3d(2.0 * kOblique), Matrix3d(Matrix3d::Zero()) })
  {
    EXPECT_NE(refusal(meta(axes), { .level = 0.0 }).find("its TransformMatrix is not three dir"),
      std::string::npos);
  }
}

// as VTK itself places its voxels, those that follow backwards, too
TEST_F(ImageAxes, OfVtiTurnAboutTheFirstVoxel)
{
  const auto image = ball(false);
  image->SetSpacing(2.0, 2.5, -3.0);
  image->SetOrigin(kOffset.data());
  vtkNew<vtkMatrix3x3> turn;
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      turn->SetElement(i, k, kOblique(i, k));
    }
  }
  image->SetDirectionMatrix(turn);
  const Vector3d index = kCenterMm.cwiseQuotient(Vector3d(2.0, 2.5, 3.0));
  Vector3d center;
  image->TransformContinuousIndexToPhysicalPoint(index.data(), center.data());
  expectBall(readSurface(write<vtkXMLImageDataWriter>("a.vti", *image), LengthUnit::Millimeter,
               { .level = 0.0 }),
    center, 1.0);

  vtkNew<vtkStringArray> space; // as the field of a surface states it
  space->SetName("SPACE");
  space->InsertNextValue("RAS");
  image->GetFieldData()->AddArray(space);
  const LoadedSurface turned = readSurface(
    write<vtkXMLImageDataWriter>("b.vti", *image), LengthUnit::Millimeter, { .level = 0.0 });
  expectBall(turned, { -center.x(), -center.y(), center.z() }, 1.0);
  EXPECT_EQ(turned.space, "LPS");
}

// numbers stay what they are: the file's unit is believed, another takes its place
TEST_F(ImageAxes, AUnitIsTakenOnce)
{
  const std::string origin = "space origin: (" + row(kOffset, ",") + ")\n";
  const std::string directions = "space directions: (2,0,0) (0,2.5,0) (0,0,3)\n";
  const std::string space = "space: left-posterior-superior\n";
  const Vector3d center = kOffset + kCenterMm;
  for (const auto& [unit, mm] :
    { std::pair("um", 1e-3), { "mm", 1.0 }, { "cm", 10.0 }, { "m", 1e3 } })
  {
    const std::string quoted = std::string("\"") + unit + "\"";
    const std::string units = "space units: " + quoted + ' ' + quoted + ' ' + quoted + '\n';
    const auto file = nrrd(space, directions + units + origin);
    expectBall(readSurface(file, {}, { .level = 0.0 }), center, mm);
    expectBall(readSurface(file, LengthUnit::Centimeter, { .level = 0.0 }), center, 10.0);
    if (mm < 1e3) // MetaImage has no name for it
    {
      const auto other = meta(Matrix3d::Identity(), unit);
      expectBall(readSurface(other, {}, { .level = 0.0 }), center, mm);
      expectBall(readSurface(other, LengthUnit::Millimeter, { .level = 0.0 }), center, 1.0);
    }
  }
  expectBall(readSurface(nrrd(space, directions + origin), {}, { .level = 0.0 }), center,
    1.0); // 3D Slicer's
  EXPECT_NE(refusal(nrrd(space, directions + "space units: \"mm\" \"mm\" \"cm\"\n" + origin),
              { .level = 0.0 })
              .find("its space units are"),
    std::string::npos);
  EXPECT_NE(refusal(nrrd("", ""), { .level = 0.0 }).find("no space directions or spacings"),
    std::string::npos);
}

// of the definition of NRRD: the first sample lies there where samples are nodes, half a step
// farther in where they are cells
TEST_F(ImageAxes, AnNrrdOfTheOlderFormBeginsWhereItsAxesDo)
{
  const std::string sizes = "spacings: 2 2.5 3\n";
  const std::string mins = sizes + "axis mins: -30 11 -77\n";
  const Vector3d begin = kCenterMm + Vector3d(-30.0, 11.0, -77.0);
  const Vector3d half(1.0, 1.25, 1.5);
  const auto read = [&](const std::string& lines)
  { return readSurface(nrrd("", lines), LengthUnit::Millimeter, { .level = 0.0 }); };
  expectBall(read(sizes), kCenterMm, 1.0);
  expectBall(read(mins), begin, 1.0);
  expectBall(read(mins + "centers: node node node\n"), begin, 1.0);
  expectBall(read(mins + "centerings: cell cell cell\n"), begin + half, 1.0);
  expectBall(read(sizes + "axis mins: nan nan nan\n"), kCenterMm, 1.0);
  EXPECT_NE(refusal(nrrd("", sizes + "axis mins: 1 2\n"), { .level = 0.0 }).find("its axis mins"),
    std::string::npos);
}

} // namespace
} // namespace palp::test
