#include "pipeline/deform/refined_surface.h"

#include "haptics/units.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "pipeline/model/poly_data.h"
#include "tests/pipeline/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;

// how far a surface is inside a tool [m]
struct Inside
{
  double points = 0.0;    // its own points
  double triangles = 0.0; // places between them
};

// by the profile of the tip, at the corners of each triangle and at 45 places within
Inside insideOf(vtkPolyData& mesh, const Press& press)
{
  const auto depth = [&](const Eigen::Vector3d& point)
  {
    const Eigen::Vector3d from = point - press.pose.apex;
    const double height = -from.dot(press.pose.axis);
    const double radius = (from + height * press.pose.axis).norm();
    constexpr double step = 1.0_um;
    const double slope =
      (tipHeight(press.tip, radius + step) - tipHeight(press.tip, radius)) / step;
    return std::min(baseRadius(press.tip) - radius,
      (height - tipHeight(press.tip, radius)) / std::hypot(1.0, slope));
  };
  Inside inside;
  const auto points = pointsOf(mesh);
  for (const Eigen::Vector3d& point : points)
  {
    inside.points = std::max(inside.points, depth(point));
  }
  for (const Triangle& t : trianglesOf(mesh))
  {
    constexpr int n = 8;
    for (int i = 0; i <= n; ++i)
    {
      for (int j = 0; i + j <= n; ++j)
      {
        const Eigen::Vector3d position =
          (i * points[t[0]] + j * points[t[1]] + (n - i - j) * points[t[2]]) / n;
        inside.triangles = std::max(inside.triangles, depth(position));
      }
    }
  }
  return inside;
}

struct Dented
{
  const char* name;
  Mesh mesh;
  Eigen::Vector3d position;
  Tip tip;
  double depth;
};

TEST(RefinedSurface, HasNoPointInsideTheToolAndCutsItLess)
{
  const Mesh block = makeBox({ 100.0_mm, 100.0_mm, 50.0_mm }, 2.3_mm);
  const Mesh ball = makeSphere(50.0_mm, 4);
  for (const Dented& with :
    { Dented{ "sphere in a block", block, { 0.3_mm, 0.2_mm, 0.0 }, SphereTip{ 10.0_mm }, 6.0_mm },
      Dented{
        "cone in a block", block, { 0.3_mm, 0.2_mm, 0.0 }, ConeTip{ 45.0_deg, 10.0_mm }, 6.0_mm },
      Dented{
        "small sphere in a ball", ball, { 0.0, 0.0, 50.0_mm }, SphereTip{ 4.0_mm }, 2.0_mm } })
  {
    vtkNew<vtkPalpDeformFilter> filter;
    filter->SetInputData(makePolyData(with.mesh.points, with.mesh.triangles));
    filter->SetGeneratePatch(true);
    const Press press =
      test::pressAt(with.position, Eigen::Vector3d::UnitZ(), with.tip, with.depth, 20.0_mm);
    filter->SetPress(press);
    for (const int level : { -1, 4 })
    {
      filter->SetPatchLevel(level);
      filter->Update();
      const Inside bare = insideOf(*filter->GetOutput(), press);
      const auto refined = refinedSurface(*filter);
      const Inside fine = insideOf(*refined, press);
      EXPECT_LE(bare.points, 1.0_um) << with.name;
      EXPECT_LE(fine.points, 1.0_um) << with.name;
      EXPECT_LT(fine.triangles, (level < 0 ? 0.6 : 0.15) * bare.triangles) << with.name;
    }
  }
}

// edges longer than the dent is wide, none of its points within, and tools with edges
TEST(RefinedSurface, HasTheWholeDentBetweenThePointsOfACoarseMesh)
{
  const Mesh block = makeBox({ 96.0_mm, 96.0_mm, 48.0_mm }, 8.0_mm);
  for (const Tip& tip : { Tip{ SphereTip{ 6.0_mm } }, Tip{ ConeTip{ 15.0_deg, 10.0_mm } },
         Tip{ TruncatedConeTip{ 20.0_deg, 1.0_mm, 6.0_mm } }, Tip{ PunchTip{ 6.0_mm } } })
  {
    for (const double depth : { 0.1_mm, 0.3_mm, 1.0_mm, 3.0_mm, 9.0_mm })
    {
      for (const Eigen::Vector3d& at :
        { Eigen::Vector3d(2.1_mm, 1.2_mm, 0.0), Eigen::Vector3d(4.0_mm, 4.0_mm, 0.0),
          Eigen::Vector3d(-7.1_mm, 3.2_mm, 0.0), Eigen::Vector3d(0.3_mm, 4.0_mm, 0.0) })
      {
        SCOPED_TRACE(testing::Message() << tip.index() << ' ' << depth << " at " << at.transpose());
        vtkNew<vtkPalpDeformFilter> filter;
        filter->SetInputData(makePolyData(block.points, block.triangles));
        filter->SetGeneratePatch(true);
        filter->SetPatchTolerance(10.0_um);
        const Press press = test::pressAt(at, Eigen::Vector3d::UnitZ(), tip, depth, 10.0_mm);
        filter->SetPress(press);
        filter->Update();
        const Inside fine = insideOf(*refinedSurface(*filter), press);
        EXPECT_LE(fine.points, 1.0_um);
        EXPECT_LE(fine.triangles, 0.01_mm);
      }
    }
  }
}

// no edge ends within another: every one belongs to two triangles, as before
TEST(RefinedSurface, HasNoGap)
{
  const Mesh block = makeBox({ 96.0_mm, 96.0_mm, 48.0_mm }, 8.0_mm);
  for (const double tolerance : { 0.0, 10.0_um })
  {
    for (const double depth : { 0.3_mm, 1.0_mm, 5.0_mm })
    {
      vtkNew<vtkPalpDeformFilter> filter;
      filter->SetInputData(makePolyData(block.points, block.triangles));
      filter->SetGeneratePatch(true);
      filter->SetPatchTolerance(tolerance);
      filter->SetPress(test::pressAt(
        { 2.1_mm, 1.2_mm, 0.0 }, Eigen::Vector3d::UnitZ(), SphereTip{ 6.0_mm }, depth, 10.0_mm));
      filter->Update();
      const auto refined = refinedSurface(*filter);
      std::map<std::pair<int, int>, int> edges;
      for (const Triangle& t : trianglesOf(*refined))
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          ++edges[std::minmax(t[k], t[(k + 1) % 3])];
        }
      }
      EXPECT_GT(refined->GetNumberOfPolys(), filter->GetOutput()->GetNumberOfPolys());
      EXPECT_TRUE(std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 2; }))
        << tolerance << ' ' << depth;
    }
  }
}

} // namespace
} // namespace palp
