#include "haptics/units.h"
#include "tests/pipeline/formats/ball_images.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <tuple>
#include <vtkImageCast.h>
#include <vtkXMLImageDataWriter.h>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

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
  const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter, { 0.5, {} });
  EXPECT_TRUE(surface.closed);
  EXPECT_LT(farthest(*surface.mesh, kCenterMm), 2.2); // half the diagonal of a voxel
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadiusMm, 3);
  EXPECT_NEAR(volumeMm3(*surface.mesh), exact, 0.02 * exact);
}

// a gyroid within a ball, half of which it fills, as a spongy body: many points of few voxels
TEST_F(Images, AFoldedBodyIsReadWithinTheMemoryOfItsImage)
{
  constexpr int size = 96;
  constexpr double radius = 0.45 * size;
  constexpr double wave = 2.0 * std::numbers::pi / 8.0; // [1/mm]
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size, size, size);
  image->AllocateScalars(VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const Vector3d at = Vector3d(image->GetPoint(i)) - Vector3d::Constant(0.5 * size);
    const Vector3d angle = wave * at;
    const double gyroid = std::sin(angle.x()) * std::cos(angle.y()) +
      std::sin(angle.y()) * std::cos(angle.z()) + std::sin(angle.z()) * std::cos(angle.x());
    image->GetPointData()->GetScalars()->SetComponent(i, 0, std::min(gyroid, radius - at.norm()));
  }
  const LoadedSurface surface = readSurface(
    write<vtkMetaImageWriter>("sponge.mha", *image), LengthUnit::Millimeter, { 0.0, {} });
  EXPECT_GT(surface.mesh->GetNumberOfPoints(), 200'000);
  const double half = 2.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  EXPECT_NEAR(volumeMm3(*surface.mesh), half, 0.05 * half);
}

TEST_F(Images, OnlyTheLargestPieceIsTaken)
{
  const auto image = ball(true);
  image->SetScalarComponentFromDouble(0, 1, 1, 0, 1.0); // at the border of the image
  const LoadedSurface surface = readSurface(
    write<vtkMetaImageWriter>("speck.mha", *image), LengthUnit::Millimeter, { 0.5, {} });
  EXPECT_LT(farthest(*surface.mesh, kCenterMm), 2.2);
  for (const std::string& note : surface.notes)
  {
    EXPECT_EQ(note.find("hollow"), std::string::npos) << note;
    EXPECT_EQ(note.find("border"), std::string::npos) << note;
  }
}

// as lesions of one label: each by itself, not only their sum
TEST_F(Images, EachPieceKeepsItsVolume)
{
  const auto image = ball(true);
  auto* voxels = image->GetPointData()->GetScalars();
  const Vector3d middle = kCenterMm - Vector3d(28.0, 36.0, 31.0);
  int count = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    if ((Vector3d(image->GetPoint(i)) - middle).norm() < 10.0)
    {
      voxels->SetComponent(i, 0, 1.0);
      ++count;
    }
  }
  ASSERT_GT(count, 200);
  ImagePart part{ 0.5, {} };
  part.components = 2;
  const LoadedSurface both =
    readSurface(write<vtkMetaImageWriter>("two.mha", *image), LengthUnit::Millimeter, part);
  part.components = 1;
  const LoadedSurface one =
    readSurface(write<vtkMetaImageWriter>("one.mha", *image), LengthUnit::Millimeter, part);
  const double small = volumeMm3(*both.mesh) - volumeMm3(*one.mesh);
  const double exact = count * Vector3d(image->GetSpacing()).prod();
  EXPECT_NEAR(small, exact, 0.01 * exact);
}

// what is around a ball: a box as large as the image with its voxels' halves, less the ball
TEST_F(Images, ALabelThatReachesTheBorderIsClosedThere)
{
  const auto file = write<vtkMetaImageWriter>("around.mha", *ball(true));
  const LoadedSurface around = readSurface(file, LengthUnit::Millimeter, { {}, { "0" } });
  EXPECT_TRUE(around.closed);
  const Vector3d box(82.0, 102.5, 93.0);
  std::array<double, 6> bounds{};
  around.mesh->GetBounds(bounds.data());
  int onFaces = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto low = bounds.at(2 * static_cast<std::size_t>(axis));
    const auto high = bounds.at(2 * static_cast<std::size_t>(axis) + 1);
    EXPECT_NEAR(units::toMillimeters(high - low), box[axis], 1e-4) << axis;
    for (vtkIdType i = 0; i < around.mesh->GetNumberOfPoints(); ++i)
    {
      const double x = around.mesh->GetPoint(i)[axis];
      onFaces += std::min(x - low, high - x) < 1e-8 ? 1 : 0;
    }
  }
  EXPECT_GT(onFaces, around.mesh->GetNumberOfPoints() / 2); // flat, but for the ball
  const double exact = box.prod() - 4.0 / 3.0 * std::numbers::pi * std::pow(kRadiusMm, 3);
  EXPECT_NEAR(volumeMm3(*around.mesh), exact, 0.01 * exact);
  EXPECT_TRUE(std::ranges::any_of(around.notes,
    [](const std::string& note)
    { return note.find("is closed there by a flat face") != note.npos; }));
}

// its hollow, where all around is 1, is as large as the ball
TEST_F(Images, AMaskTurnedAroundIsTheSameBody)
{
  const auto image = ball(true);
  auto* voxels = image->GetPointData()->GetScalars();
  double count = 0.0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    voxels->SetComponent(i, 0, 1.0 - voxels->GetComponent(i, 0));
    count += 1.0 - voxels->GetComponent(i, 0);
  }
  const auto file = write<vtkMetaImageWriter>("turned.mha", *image);
  const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter, { 0.5, {} });
  EXPECT_LT(farthest(*surface.mesh, kCenterMm), 2.2);
  EXPECT_NEAR(volumeMm3(*surface.mesh), 15.0 * count, 0.01 * 15.0 * count); // of 2 x 2.5 x 3 mm
}

// as a distance has it, negative within
TEST_F(Images, TellsThatABodyIsBelowItsLevel)
{
  const auto notesOf = [&](const std::string& name, bool mask, double level)
  {
    std::string all;
    for (const std::string& note : readSurface(write<vtkMetaImageWriter>(name, *ball(mask)),
           LengthUnit::Millimeter,
           { level, {} }).notes)
    {
      all += note + '\n';
    }
    return all;
  };
  const std::string told = "the body is what is below the level";
  EXPECT_NE(notesOf("distance.mha", false, 0.0).find(told), std::string::npos);
  EXPECT_EQ(notesOf("above.mha", true, 0.5).find(told), std::string::npos);
}

TEST_F(Images, RefusesWithTheValuesThatThereAre)
{
  const auto mask = write<vtkMetaImageWriter>("mask.mha", *ball(true));
  EXPECT_NE(refusal(mask, {}).find(
              "name the value of the surface with a level (--level), its values go from "
              "0 to 1"),
    std::string::npos);
  EXPECT_NE(refusal(mask, { 3.0, {} }).find("no surface at level 3"), std::string::npos);
  const std::filesystem::path stl = folder_.path() / "a.stl";
  std::ofstream(stl) << "solid a\nendsolid a\n";
  EXPECT_NE(refusal(stl, { 1.0, {} }).find("leave the level out"), std::string::npos);
  EXPECT_NE(refusal(stl, { {}, { "5" } }).find("leave the label out"), std::string::npos);
}

// a ball of label 5 in a ball of label 2, and a box of label 7
vtkSmartPointer<vtkImageData> labels()
{
  auto image = ball(true);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const Vector3d position(image->GetPoint(i));
    const double distance = (position - kCenterMm).norm();
    const double value = distance < 20.0 ? 2.0
      : distance < kRadiusMm             ? 5.0
      : position.z() > 80.0              ? 7.0
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
    EXPECT_NE(refusal(file, { level, {} }).find("its labels are 2 ("), std::string::npos);
  }
  EXPECT_NE(refusal(file, { {}, { "4" } }).find("no label 4 in it"), std::string::npos);
  const LoadedSurface inner = readSurface(file, LengthUnit::Millimeter, { {}, { "2" } });
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(20.0, 3);
  EXPECT_NEAR(volumeMm3(*inner.mesh), exact, 0.03 * exact);
  const LoadedSurface both = readSurface(file, LengthUnit::Millimeter, { {}, { "2", "5" } });
  EXPECT_TRUE(both.closed);
  EXPECT_LT(farthest(*both.mesh, kCenterMm), 2.2);
}

// as those of brain atlases, which differ in their last digits
TEST_F(Images, LargeLabelsAreToldApart)
{
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(40, 20, 20);
  image->SetSpacing(2.0, 2.0, 2.0);
  image->AllocateScalars(VTK_UNSIGNED_INT, 1);
  image->GetPointData()->GetScalars()->Fill(0.0);
  const auto fill = [&](int from, int to, double label)
  {
    for (int i = from; i < to; ++i)
    {
      for (int jk = 0; jk < 100; ++jk)
      {
        image->SetScalarComponentFromDouble(i, 5 + jk % 10, 5 + jk / 10, 0, label);
      }
    }
  };
  fill(3, 9, 312782550.0);
  fill(14, 22, 312782554.0);
  fill(27, 37, 4294967295.0);
  fill(38, 39, 2e9);
  const auto file = write<vtkMetaImageWriter>("atlas.mha", *image);
  for (const auto& [label, from, to] : { std::tuple("312782550", 3, 9), { "312782554", 14, 22 },
         { "4294967295", 27, 37 }, { "312782554.0", 14, 22 } })
  {
    const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter, { {}, { label } });
    const double* box = surface.mesh->GetBounds();
    EXPECT_NEAR(1e3 * box[0], 2.0 * from - 1.0, 1.1) << label;
    EXPECT_NEAR(1e3 * box[1], 2.0 * to - 1.0, 1.1) << label;
  }
  EXPECT_NE(refusal(file, {}).find("its labels are 312782550 (600 voxels"), std::string::npos)
    << refusal(file, {});
  EXPECT_NE(refusal(file, {}).find(", 2000000000 (100 voxels"), std::string::npos)
    << refusal(file, {});
  for (const char* label : { "312782551", "312782530", "4294967294", "312782550.5" })
  {
    EXPECT_NE(refusal(file, { {}, { label } }).find("no label " + std::string(label) + " in it"),
      std::string::npos);
  }
}

TEST_F(Images, ALabelOfFewVoxelsIsRefusedByTheirNumber)
{
  const auto image = labels();
  image->SetScalarComponentFromDouble(3, 3, 3, 0, 9.0);
  const auto file = write<vtkMetaImageWriter>("speck.mha", *image);
  EXPECT_NE(
    refusal(file, { {}, { "9" } }).find("has 1 voxel, too few for a surface"), std::string::npos);
}

TEST_F(Images, ALabelThatFillsTheImageIsABox)
{
  auto image = ball(true);
  image->GetPointData()->GetScalars()->Fill(1.0);
  const auto full = write<vtkMetaImageWriter>("full.mha", *image);
  const double box = 82.0 * 102.5 * 93.0;
  const LoadedSurface one = readSurface(full, LengthUnit::Millimeter, { {}, { "1" } });
  EXPECT_NEAR(volumeMm3(*one.mesh), box, 0.01 * box);
  EXPECT_NE(refusal(full, { {}, { "2" } }).find("no label 2 in it"), std::string::npos);
  const auto parts = write<vtkMetaImageWriter>("parts.mha", *labels());
  const LoadedSurface all =
    readSurface(parts, LengthUnit::Millimeter, { {}, { "0", "2", "5", "7" } });
  EXPECT_NEAR(volumeMm3(*all.mesh), box, 0.01 * box);
}

// 2, 5 and 7 are three of its labels
TEST_F(Images, ARangeOfValuesIsOneBodyOfWhatHasThem)
{
  const auto file = write<vtkMetaImageWriter>("parts.mha", *labels());
  const auto volumeOf = [&](const ImagePart& part)
  { return volumeMm3(*readSurface(file, LengthUnit::Millimeter, part).mesh); };
  EXPECT_EQ(volumeOf({ .band = { { 1.5, 5.0 } } }), volumeOf({ .labels = { "2", "5" } }));
  EXPECT_EQ(volumeOf({ .band = { { 5.0, 5.0 } } }), volumeOf({ .labels = { "5" } }));
  EXPECT_NE(refusal(file, { .band = { { 7.5, 99.0 } } }).find("no voxel has a value from 7.5"),
    std::string::npos);
}

// one that fills the image is a label, too; what is no number is neither label nor background
TEST_F(Images, AMaskIsALabelMapAndHasNumbersOnly)
{
  const auto image = ball(true);
  image->GetPointData()->GetScalars()->Fill(3.0);
  const FileOrgans full = readFileOrgans(write<vtkMetaImageWriter>("full.mha", *image), {}, true);
  ASSERT_EQ(full.organs.size(), 1U);
  EXPECT_EQ(full.organs[0].label, "3");
  EXPECT_EQ(full.organs[0].voxels, 41U * 41U * 31U);

  vtkNew<vtkImageCast> cast;
  cast->SetInputData(labels());
  cast->SetOutputScalarTypeToFloat();
  cast->Update();
  cast->GetOutput()->SetScalarComponentFromDouble(7, 5, 6, 0, std::nan(""));
  const auto file = write<vtkMetaImageWriter>("nan.mha", *cast->GetOutput());
  const auto refused = [&](const std::vector<std::string>& asked)
  {
    try
    {
      (void)readFileOrgans(file, { .labels = asked }, false);
      return std::string();
    }
    catch (const Error& error)
    {
      return std::string(error.what());
    }
  };
  for (const std::string& message :
    { refused({}), refused({ "2" }), refusal(file, { {}, { "2" } }) })
  {
    EXPECT_NE(message.find("1, the first at 7, 5, 6"), std::string::npos) << message;
  }
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
  const LoadedSurface middle = readSurface(file, LengthUnit::Millimeter, { 127.5, {} });
  const LoadedSurface low = readSurface(file, LengthUnit::Millimeter, { 0.5, {} });
  EXPECT_EQ(pointsOf(*low.mesh), pointsOf(*middle.mesh));
  EXPECT_NE(low.notes[2].find("its surface is taken at 127.5, their middle"), std::string::npos);
}

} // namespace
} // namespace palp::test
