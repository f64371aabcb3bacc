#include "tests/pipeline/formats/ball_images.h"

#include <algorithm>
#include <functional>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

// of a closed surface where it meets a plane across x
double sectionAt(const LoadedSurface& surface, double x)
{
  const std::vector<Vector3d> points = pointsOf(*surface.mesh);
  double area = 0.0;
  for (const Triangle& triangle : trianglesOf(*surface.mesh))
  {
    std::vector<Vector3d> crossed; // into the half space, and out of it
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Vector3d& a = points[at(triangle[i])];
      const Vector3d& b = points[at(triangle[(i + 1) % 3])];
      if ((a.x() > x) != (b.x() > x))
      {
        const auto where = a.x() > x ? crossed.end() : crossed.begin();
        crossed.insert(where, a + (x - a.x()) / (b.x() - a.x()) * (b - a));
      }
    }
    area += crossed.empty() ? 0.0 : 0.5 * crossed[0].cross(crossed[1]).x();
  }
  return std::abs(area);
}

// A vessel that goes on as a branch, or an organ with a thin lobe: what smoothing takes of the thin
// part is not given to the thick one. By counted voxels.
TEST_F(Images, ABranchKeepsItsSection)
{
  constexpr double kTrunk = 8.0;
  for (const double radius : { 1.0, 1.5, 2.0, 2.5, 3.5, 6.0 })
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(96, 24, 24);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    std::vector<double> voxels(96, 0.0); // of each section
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const Vector3d point(image->GetPoint(i));
      const double off = std::hypot(point.y() - 11.0, point.z() - 12.0);
      const bool isIn =
        point.x() > 3.0 && point.x() < 92.0 && off <= (point.x() > 40.0 ? radius : kTrunk);
      image->GetPointData()->GetScalars()->SetComponent(i, 0, isIn ? 1.0 : 0.0);
      voxels[static_cast<std::size_t>(point.x())] += isIn ? 1.0 : 0.0;
    }
    const LoadedSurface surface = readSurface(write<vtkMetaImageWriter>("branch.mha", *image),
      LengthUnit::Millimeter, { .labels = { "1" } });
    for (const std::size_t x : { 15UL, 25UL, 55UL, 65UL, 75UL })
    {
      const double exact = voxels[x];
      EXPECT_NEAR(1e6 * sectionAt(surface, 1e-3 * (static_cast<double>(x) + 0.013)), exact,
        (radius < 1.5 ? 0.1 : 0.05) * exact)
        << "radius " << radius << " at " << x;
    }
  }
}

// with a voxel or a ball of 12 mm missing in its middle
TEST_F(Images, AHollowStaysAndAPoreIsFilled)
{
  const double ball30 = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadiusMm, 3);
  const double ball12 = 4.0 / 3.0 * std::numbers::pi * std::pow(12.0, 3);
  for (const auto& [radius, words, volume] :
    { std::tuple(2.0, "1 piece, and 1 hollow of less than 100", ball30),
      { 12.0, "1 piece, with 1 hollow", ball30 - ball12 } })
  {
    const auto image = ball(true);
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      if ((Vector3d(image->GetPoint(i)) - kCenterMm).norm() < radius)
      {
        image->GetPointData()->GetScalars()->SetComponent(i, 0, 0.0);
      }
    }
    const LoadedSurface surface = readSurface(
      write<vtkMetaImageWriter>("hollow.mha", *image), LengthUnit::Millimeter, { 0.5, {} });
    std::string all;
    for (const std::string& note : surface.notes)
    {
      all += note + '\n';
    }
    EXPECT_NE(all.find(words), std::string::npos) << all;
    EXPECT_NEAR(volumeMm3(*surface.mesh), volume, 0.02 * ball30);
  }
}

// filled, they add their own voxels and no more, however many there are
TEST_F(Images, ManySmallHollowsLeaveTheOutsideWhereItIs)
{
  std::mt19937 random(3);
  std::bernoulli_distribution isMissing(0.03);
  const auto scattered = [&](const Vector3d& /*place*/) { return isMissing(random); };
  const auto regular = [](const Vector3d& place)
  { return (place / 14.0 - (place / 14.0).array().round().matrix()).norm() * 14.0 < 5.0; };
  for (const std::function<bool(const Vector3d&)>& isHollow :
    std::vector<std::function<bool(const Vector3d&)>>{ scattered, regular })
  {
    const auto image = ball(true);
    auto* voxels = image->GetPointData()->GetScalars();
    double whole = 0.0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      whole += voxels->GetComponent(i, 0);
      const Vector3d place = Vector3d(image->GetPoint(i)) - kCenterMm;
      if (place.norm() < kRadiusMm - 7.0 && isHollow(place))
      {
        voxels->SetComponent(i, 0, 0.0);
      }
    }
    const LoadedSurface surface = readSurface(
      write<vtkMetaImageWriter>("pores.mha", *image), LengthUnit::Millimeter, { 0.5, {} });
    const double volume = whole * Vector3d(image->GetSpacing()).prod();
    EXPECT_NEAR(volumeMm3(*surface.mesh), volume, 0.005 * volume);
    EXPECT_LT(farthest(*surface.mesh, kCenterMm), 1.5);
  }
}

// a stone in a hollow that is filled is a part of what fills it, and in a larger one a second piece
TEST_F(Images, AStoneInAFilledHollowIsNoPieceOfItsOwn)
{
  for (const auto& [hollow, words] :
    { std::pair(2, "1 piece, and 1 hollow of less"), { 4, "2 pieces, with 1 hollow" } })
  {
    const auto image = ball(true);
    auto* voxels = image->GetPointData()->GetScalars();
    const Vector3d spacing(image->GetSpacing());
    double chosen = 0.0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const Eigen::Array3d off =
        ((Vector3d(image->GetPoint(i)) - kCenterMm).array() / spacing.array()).abs();
      const double inner = off.floor().maxCoeff(); // a shell of cubes of voxels
      chosen += voxels->GetComponent(i, 0);
      if (inner == hollow - 1)
      {
        voxels->SetComponent(i, 0, 0.0);
        chosen -= hollow > 2 ? 1.0 : 0.0;
      }
    }
    ImagePart part{ .level = 0.5, .labels = {} };
    part.components = ImagePart::kAllComponents;
    const LoadedSurface surface =
      readSurface(write<vtkMetaImageWriter>("stone.mha", *image), LengthUnit::Millimeter, part);
    EXPECT_TRUE(std::ranges::any_of(surface.notes,
      [&words = words](const std::string& note) { return note.find(words) != note.npos; }))
      << hollow;
    EXPECT_NEAR(volumeMm3(*surface.mesh) / spacing.prod(), chosen, 5.0) << hollow;
  }
}

// a cube of 18 voxels with a hollow of 12 that holds one of 8; beside it one of 10 with a hollow of
// 6: hollows go with the body around them
TEST_F(Images, HollowsGoWithTheBodyAroundThem)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(40, 24, 24);
  image->SetSpacing(1.0, 1.5, 0.75);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  const auto isIn = [](const Eigen::Array3i& voxel, const Eigen::Array3i& low, int side)
  { return (voxel >= low).all() && (voxel < low + side).all(); };
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const Eigen::Array3i voxel(
      static_cast<int>(i % 40), static_cast<int>(i / 40 % 24), static_cast<int>(i / 960));
    const bool isLarge = isIn(voxel, { 2, 3, 3 }, 18) != isIn(voxel, { 5, 6, 6 }, 12);
    const bool isSmall = isIn(voxel, { 26, 8, 8 }, 10) != isIn(voxel, { 28, 10, 10 }, 6);
    const bool isInside = isIn(voxel, { 7, 8, 8 }, 8);
    image->GetPointData()->GetScalars()->SetComponent(
      i, 0, isLarge || isSmall || isInside ? 1.0 : 0.0);
  }
  const auto file = write<vtkMetaImageWriter>("shells.mha", *image);
  constexpr double kLarge = 18.0 * 18.0 * 18.0 - 12.0 * 12.0 * 12.0;
  constexpr double kSmall = 10.0 * 10.0 * 10.0 - 6.0 * 6.0 * 6.0;
  for (const auto& [components, words, voxels] :
    { std::tuple(1UL, "the largest of its 3 pieces is taken, with 1 hollow", kLarge),
      { 2UL, "the 2 largest of its 3 pieces are taken, with 2 hollows", kLarge + kSmall },
      { ImagePart::kAllComponents, "3 pieces, with 2 hollows", kLarge + kSmall + 512.0 } })
  {
    ImagePart part{ .labels = { "1" } };
    part.components = components;
    const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter, part);
    EXPECT_TRUE(std::ranges::any_of(surface.notes,
      [&words = words](const std::string& note) { return note.find(words) != note.npos; }))
      << words;
    EXPECT_NEAR(volumeMm3(*surface.mesh) / (1.5 * 0.75), voxels, 0.005 * voxels) << words;
    EXPECT_TRUE(surface.closed);
  }
}

// In a block: a tumor, one that comes out of it by a quarter, and one with a gap around it. Beside
// it: another block, against one of its sides. Each has its value and what says that it is held.
TEST_F(Images, LabelsThatABodyHoldsAreTold)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(48, 30, 30);
  image->AllocateScalars(VTK_SHORT, 1);
  image->GetPointData()->GetScalars()->Fill(0.0);
  const auto fill = [&](const Eigen::Array3i& low, const Eigen::Array3i& size, int value)
  {
    for (int i = 0; i < size.prod(); ++i)
    {
      const Eigen::Array3i to(i % size[0], i / size[0] % size[1], i / size[0] / size[1]);
      const Eigen::Array3i at = low + to;
      image->SetScalarComponentFromDouble(at[0], at[1], at[2], 0, value);
    }
  };
  fill({ 2, 2, 2 }, { 24, 26, 26 }, 10);
  fill({ 6, 6, 6 }, { 8, 4, 4 }, 2);
  fill({ 18, 6, 18 }, { 8, 6, 6 }, 300); // at the side of the block, and so of its box
  fill({ 5, 16, 16 }, { 8, 8, 8 }, 0);
  fill({ 7, 18, 18 }, { 4, 4, 4 }, 7);
  fill({ 26, 2, 2 }, { 20, 26, 26 }, 4);
  fill({ 25, 6, 18 }, { 1, 6, 6 }, 10);
  const auto file = write<vtkMetaImageWriter>("held.mha", *image);
  const auto told = [&](const std::vector<std::string>& labels)
  {
    std::string all;
    const auto surface = readSurface(file, LengthUnit::Millimeter, { .labels = labels });
    for (const std::string& note : surface.notes)
    {
      all += note.find("left out of it") == note.npos ? "" : note;
    }
    return all;
  };
  EXPECT_NE(
    told({ "10" }).find("labels 2, 300 meet it with most of their sides"), std::string::npos)
    << told({ "10" });
  EXPECT_NE(told({ "10" }).find("as 10+2+300 they are one"), std::string::npos) << told({ "10" });
  EXPECT_NE(
    told({ "10", "2" }).find("label 300 meets it with most of its sides"), std::string::npos);
  EXPECT_EQ(told({ "10", "2", "300" }), "");
  for (const char* other : { "2", "300", "4", "7" })
  {
    EXPECT_EQ(told({ other }), "") << other;
  }
}

// which smoothing would leave nothing of, however many there are
TEST_F(Images, OfSingleVoxelsIsNoBody)
{
  const auto image = ball(true);
  auto* voxels = image->GetPointData()->GetScalars();
  voxels->Fill(0.0);
  for (int i = 3; i < 25; ++i) // which touch in corners
  {
    voxels->SetComponent(i * (1 + 41 + 41 * 41), 0, 1.0);
  }
  ImagePart part{ .level = 0.5, .labels = {} };
  part.components = ImagePart::kAllComponents;
  const auto file = write<vtkMetaImageWriter>("chain.mha", *image);
  try
  {
    (void)readSurface(file, LengthUnit::Millimeter, part);
    ADD_FAILURE();
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("less than eight voxels"), std::string::npos)
      << error.what();
  }
}

} // namespace
} // namespace palp::test
