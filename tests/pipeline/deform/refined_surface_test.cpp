#include "pipeline/deform/refined_surface.h"

#include "haptics/units.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "pipeline/model/poly_data.h"
#include "tests/pipeline/surfaces.h"

#include <algorithm>
#include <gtest/gtest.h>
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
    return std::min(baseRadius(press.tip) - radius, height - tipHeight(press.tip, radius));
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

struct Case
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
  for (const Case& with :
    { Case{ "sphere in a block", block, { 0.3_mm, 0.2_mm, 0.0 }, SphereTip{ 10.0_mm }, 6.0_mm },
      Case{
        "cone in a block", block, { 0.3_mm, 0.2_mm, 0.0 }, ConeTip{ 45.0_deg, 10.0_mm }, 6.0_mm },
      Case{ "small sphere in a ball", ball, { 0.0, 0.0, 50.0_mm }, SphereTip{ 4.0_mm }, 2.0_mm } })
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

} // namespace
} // namespace palp
