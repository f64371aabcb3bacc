#include "pipeline/model/level_lines.h"

#include "pipeline/model/poly_data.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// a plane of squares of 1, each of two triangles
struct Plane
{
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;
};

Plane planeOf(int side)
{
  Plane plane;
  for (int i = 0; i < side * side; ++i)
  {
    plane.points.emplace_back(i % side - 0.5 * (side - 1), i / side - 0.5 * (side - 1), 0.0);
  }
  for (int i = 0; i < side * (side - 1); ++i)
  {
    if (i % side != side - 1)
    {
      plane.triangles.push_back({ i, i + 1, i + side });
      plane.triangles.push_back({ i + 1, i + side + 1, i + side });
    }
  }
  return plane;
}

TEST(LevelLines, OfADistanceAreACircleInOnePiece)
{
  constexpr float kRadius = 25.3F;
  const Plane plane = planeOf(81);
  vtkNew<vtkFloatArray> distances;
  vtkNew<vtkFloatArray> places;
  distances->SetName("distance");
  places->SetName("place");
  places->SetNumberOfComponents(3);
  for (const Eigen::Vector3d& point : plane.points)
  {
    distances->InsertNextValue(static_cast<float>(point.norm()));
    places->InsertNextTuple(point.data());
  }
  const auto surface = makePolyData(plane.points, plane.triangles);
  surface->GetPointData()->AddArray(distances);
  surface->GetPointData()->AddArray(places);
  vtkNew<vtkPolyData> lines;
  addLevelLines(*surface, plane.triangles, "distance", "place", kRadius, *lines);
  vtkDataArray& between = *lines->GetPointData()->GetArray("place");
  std::vector<int> ends(static_cast<std::size_t>(lines->GetNumberOfPoints()));
  std::vector<int> begins(ends.size());
  double length = 0.0;
  for (vtkIdType i = 0; i < lines->GetNumberOfLines(); ++i)
  {
    vtkNew<vtkIdList> two;
    lines->GetCellPoints(i, two);
    ++begins[static_cast<std::size_t>(two->GetId(0))];
    const Eigen::Vector3d a(lines->GetPoint(two->GetId(0)));
    const Eigen::Vector3d b(lines->GetPoint(two->GetId(1)));
    length += (a - b).norm();
    ++ends[static_cast<std::size_t>(two->GetId(0))];
    ++ends[static_cast<std::size_t>(two->GetId(1))];
  }
  for (vtkIdType i = 0; i < lines->GetNumberOfPoints(); ++i)
  {
    const Eigen::Vector3d at(lines->GetPoint(i));
    EXPECT_NEAR(at.norm(), kRadius, 2.0 / 8.0 / kRadius + 1e-6); // h^2 / 8 R, of a diagonal
    EXPECT_EQ(ends[static_cast<std::size_t>(i)], 2) << "a loose end";
    EXPECT_EQ(begins[static_cast<std::size_t>(i)], 1) << "all run the same way round";
    EXPECT_NEAR((at - Eigen::Vector3d(between.GetTuple3(i))).norm(), 0.0, 1e-6);
  }
  EXPECT_NEAR(length, 2.0 * std::numbers::pi * kRadius, 0.01 * kRadius);
}

TEST(LevelLines, AreAddedToOthersAndNoneWithoutACrossing)
{
  const std::vector<Triangle> triangles{ { 0, 1, 2 }, { 1, 3, 2 } };
  const std::vector<float> values{ 0.0F, 1.0F, 1.0F, 3.0F };
  EXPECT_TRUE(levelLines(triangles, values, 4.0F).lines.empty());
  EXPECT_TRUE(levelLines(triangles, values, 0.0F).points.empty()) << "none is below";
  const LevelLines lines = levelLines(triangles, values, 2.0F);
  ASSERT_EQ(lines.lines.size(), 1U);
  EXPECT_EQ(lines.points[0].t, 0.5F);
  EXPECT_EQ(lines.points[1].t, 0.5F);
  EXPECT_EQ(levelLines(triangles, values, 1.0F).lines.size(), 1U) << "along an edge, once";
}

} // namespace
} // namespace palp
