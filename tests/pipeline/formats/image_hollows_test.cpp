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
    EXPECT_TRUE(std::ranges::any_of(
      surface.notes, [&](const std::string& note) { return note.find(words) != note.npos; }))
      << hollow;
    EXPECT_NEAR(volumeMm3(*surface.mesh) / spacing.prod(), chosen, 5.0) << hollow;
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
