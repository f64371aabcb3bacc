#include "haptics/units.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "tests/pipeline/surfaces.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <vector>
#include <vtkCellArrayIterator.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kBallRadius = 50.0_mm;

// at an angle from the top of the ball
Press pressAside(double angle, double depth)
{
  const Eigen::Vector3d outward(std::sin(angle), 0.0, std::cos(angle));
  return test::pressAt(kBallRadius * outward, outward, SphereTip{ 10.0_mm }, depth, 15.0_mm);
}

Eigen::Vector3f tuple(vtkDataArray* array, vtkIdType point)
{
  return Eigen::Map<const Eigen::Vector3f>(
    vtkFloatArray::SafeDownCast(array)->GetPointer(0) + 3 * point);
}

class SecondDent : public testing::Test
{
protected:
  SecondDent()
  {
    source_->SetRadius(kBallRadius);
    source_->SetThetaResolution(120);
    source_->SetPhiResolution(90);
    source_->Update();
    for (vtkPalpDeformFilter* filter :
      { both_.Get(), other_.Get(), alone_[0].Get(), alone_[1].Get() })
    {
      filter->SetInputConnection(source_->GetOutputPort());
    }
    both_->SetInputConnection(1, other_->GetOutputPort());
  }

  void press(const Press& first, const Press& second)
  {
    both_->SetPress(first);
    other_->SetPress(second);
    both_->Update();
    alone_[0]->SetPress(first);
    alone_[1]->SetPress(second);
    alone_[0]->Update();
    alone_[1]->Update();
  }

  // by filters of one dent each
  void expectTheDeeperOne() const
  {
    vtkPolyData* output = both_->GetOutput();
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      std::array<Eigen::Vector3f, 2> moved;
      for (std::size_t k = 0; k < 2; ++k)
      {
        moved[k] = tuple(alone_[k]->GetOutput()->GetPointData()->GetArray("Displacement"), i);
      }
      const Eigen::Vector3f& deeper =
        moved[0].squaredNorm() >= moved[1].squaredNorm() ? moved[0] : moved[1];
      ASSERT_EQ(tuple(output->GetPointData()->GetArray("Displacement"), i), deeper) << i;
      const Eigen::Vector3f rest = tuple(source_->GetOutput()->GetPoints()->GetData(), i);
      ASSERT_LT((tuple(output->GetPoints()->GetData(), i) - rest - deeper).norm(), 1e-8F) << i;
    }
  }

  // by the areas of the triangles around each point, as they lie now
  void expectNormalsOfTheSurface() const
  {
    vtkPolyData* output = both_->GetOutput();
    std::vector<Eigen::Vector3d> sums(
      static_cast<std::size_t>(output->GetNumberOfPoints()), Eigen::Vector3d::Zero());
    const auto cells = vtk::TakeSmartPointer(output->GetPolys()->NewIterator());
    for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
    {
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      cells->GetCurrentCell(count, ids);
      std::array<Eigen::Vector3d, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
      {
        output->GetPoint(ids[k], p[k].data());
      }
      for (std::size_t k = 0; k < 3; ++k)
      {
        sums[static_cast<std::size_t>(ids[k])] += (p[1] - p[0]).cross(p[2] - p[0]);
      }
    }
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const Eigen::Vector3d normal = tuple(output->GetPointData()->GetNormals(), i).cast<double>();
      ASSERT_GT(normal.dot(sums[static_cast<std::size_t>(i)].normalized()), 1.0 - 1e-4) << i;
    }
  }

  // whoever sends the touched points alone to a card shows all that changed
  void expectTouchedPointsToBeAllThatChanged() const
  {
    vtkPolyData* output = both_->GetOutput();
    auto* touched = vtkIntArray::SafeDownCast(output->GetFieldData()->GetArray("TouchedPoints"));
    const std::set<int> points(
      touched->GetPointer(0), touched->GetPointer(0) + touched->GetNumberOfValues());
    EXPECT_EQ(points.size(), static_cast<std::size_t>(touched->GetNumberOfValues())) << "once each";
    vtkNew<vtkPalpDeformFilter> rest;
    rest->SetInputConnection(source_->GetOutputPort());
    rest->Update();
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const bool isSame = tuple(output->GetPoints()->GetData(), i) ==
          tuple(rest->GetOutput()->GetPoints()->GetData(), i) &&
        tuple(output->GetPointData()->GetNormals(), i) ==
          tuple(rest->GetOutput()->GetPointData()->GetNormals(), i);
      ASSERT_TRUE(isSame || points.count(static_cast<int>(i)) == 1) << i;
    }
  }

  vtkNew<vtkSphereSource> source_;
  vtkNew<vtkPalpDeformFilter> both_;
  vtkNew<vtkPalpDeformFilter> other_;
  std::array<vtkNew<vtkPalpDeformFilter>, 2> alone_;
};

TEST_F(SecondDent, EachPointGoesWhereTheDeeperOneHasIt)
{
  for (const double apart : { 90.0_deg, 25.0_deg, 10.0_deg, 0.0 }) // apart, and one in the other
  {
    for (const double depth : { 1.0_mm, 6.0_mm })
    {
      press(pressAside(-0.5 * apart, 4.0_mm), pressAside(0.5 * apart, depth));
      expectTheDeeperOne();
      expectNormalsOfTheSurface();
      expectTouchedPointsToBeAllThatChanged();
      EXPECT_EQ(both_->GetDent().meetsOther(), apart < 60.0_deg);
    }
  }
}

TEST_F(SecondDent, OfAToolThatLeavesNothingIsLeft)
{
  press(pressAside(-10.0_deg, 4.0_mm), pressAside(10.0_deg, 6.0_mm));
  press(pressAside(-10.0_deg, 4.0_mm), {});
  expectTheDeeperOne();
  expectNormalsOfTheSurface();
  EXPECT_TRUE(both_->GetDent().deepened().empty());
  press({}, pressAside(10.0_deg, 6.0_mm));
  expectTheDeeperOne();
  press({}, {});
  vtkPolyData* output = both_->GetOutput();
  vtkNew<vtkPalpDeformFilter> rest;
  rest->SetInputConnection(source_->GetOutputPort());
  rest->Update();
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    ASSERT_EQ(tuple(output->GetPoints()->GetData(), i),
      tuple(rest->GetOutput()->GetPoints()->GetData(), i));
    ASSERT_EQ(tuple(output->GetPointData()->GetNormals(), i),
      tuple(rest->GetOutput()->GetPointData()->GetNormals(), i));
  }
}

} // namespace
} // namespace palp
