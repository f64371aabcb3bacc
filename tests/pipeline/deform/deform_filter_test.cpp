#include "pipeline/deform/vtkPalpDeformFilter.h"

#include "haptics/units.h"
#include "tests/pipeline/surfaces.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkElevationFilter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkTriangleFilter.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kRadius = 50.0_mm;

vtkNew<vtkSphereSource> ball()
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(kRadius);
  source->SetThetaResolution(80);
  source->SetPhiResolution(60);
  return source;
}

Press pressOnTop(double depth)
{
  return test::pressAt(
    { 0.0, 0.0, kRadius }, Eigen::Vector3d::UnitZ(), SphereTip{ 10.0_mm }, depth, 15.0_mm);
}

class CountErrors : public vtkCommand
{
public:
  static CountErrors* New()
  {
    return new CountErrors;
  }
  void Execute(vtkObject*, unsigned long, void*) override
  {
    ++this->Errors;
  }
  int Errors = 0;
};

TEST(DeformFilter, KeepsTheTopologyAndGivesDisplacementAndZone)
{
  const auto source = ball();
  vtkNew<vtkPalpDeformFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetPress(pressOnTop(4.0_mm));
  filter->Update();
  vtkPolyData* input = source->GetOutput();
  vtkPolyData* output = filter->GetOutput();
  EXPECT_EQ(output->GetPolys(), input->GetPolys());
  auto* moved = vtkFloatArray::SafeDownCast(output->GetPointData()->GetArray("Displacement"));
  ASSERT_TRUE(moved);
  ASSERT_TRUE(output->GetPointData()->GetArray("Zone"));
  ASSERT_TRUE(output->GetPointData()->GetNormals());
  double deepest = 0.0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    double from[3];
    double to[3];
    input->GetPoint(i, from);
    output->GetPoint(i, to);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(to[k] - from[k], moved->GetComponent(i, k), 1e-8);
    }
    deepest = std::min(deepest, to[2] - from[2]);
  }
  EXPECT_NEAR(deepest, -4.0_mm, 1e-8); // the pole is a point of the mesh
}

TEST(DeformFilter, ChangesItsArraysInPlaceAndMarksThem)
{
  const auto source = ball();
  vtkNew<vtkPalpDeformFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetPress(pressOnTop(2.0_mm));
  filter->Update();
  vtkPoints* points = filter->GetOutput()->GetPoints();
  const vtkMTimeType before = filter->GetOutput()->GetMTime();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetMTime(), before); // nothing to do
  filter->SetPress(pressOnTop(3.0_mm));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPoints(), points);
  EXPECT_GT(filter->GetOutput()->GetMTime(), before);
}

TEST(DeformFilter, ServesOtherConsumersOfItsOutput)
{
  const auto source = ball();
  vtkNew<vtkPalpDeformFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkElevationFilter> height;
  height->SetInputConnection(filter->GetOutputPort());
  height->SetLowPoint(0.0, 0.0, 0.0);
  height->SetHighPoint(0.0, 0.0, 1.0);
  const auto top = [&]
  {
    height->Update();
    return height->GetOutput()->GetPointData()->GetArray("Elevation")->GetTuple1(0);
  };
  EXPECT_NEAR(top(), kRadius, 1e-7);
  filter->SetPress(pressOnTop(4.0_mm));
  EXPECT_NEAR(top(), kRadius - 4.0_mm, 1e-7);
  filter->SetPress(Press{});
  EXPECT_NEAR(top(), kRadius, 1e-7);
}

TEST(DeformFilter, TakesAnotherInputWhileItRuns)
{
  vtkNew<vtkPalpDeformFilter> filter;
  const auto first = ball();
  filter->SetInputConnection(first->GetOutputPort());
  filter->SetPress(pressOnTop(4.0_mm));
  filter->Update();
  first->SetThetaResolution(40);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), first->GetOutput()->GetNumberOfPoints());

  vtkNew<vtkPolyData> doubles; // the same in double, edited by its owner
  doubles->DeepCopy(first->GetOutput());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->DeepCopy(first->GetOutput()->GetPoints());
  doubles->SetPoints(points);
  filter->SetInputData(doubles);
  filter->Update();
  EXPECT_NEAR(filter->GetOutput()->GetPoint(0)[2], kRadius - 4.0_mm, 1e-7);
  points->SetPoint(1, 0.0, 0.0, -60.0_mm);
  points->Modified();
  filter->Update();
  EXPECT_NEAR(filter->GetOutput()->GetPoint(1)[2], -60.0_mm, 1e-7);
}

TEST(DeformFilter, GivesTheDentAloneOnRequest)
{
  const auto source = ball();
  vtkNew<vtkPalpDeformFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetPress(pressOnTop(4.0_mm));
  filter->Update();
  EXPECT_EQ(filter->GetOutput(1)->GetNumberOfPoints(), 0);
  filter->GeneratePatchOn();
  filter->SetPatchLevel(0);
  filter->Update();
  vtkPolyData* patch = filter->GetOutput(1);
  ASSERT_TRUE(patch->GetPointData()->GetArray("Displacement [mm]"));
  double range[2];
  patch->GetPointData()->GetArray("Displacement [mm]")->GetRange(range);
  EXPECT_NEAR(range[0], 0.0, 1e-9);
  EXPECT_NEAR(range[1], 4.0, 1e-5);

  // every triangle with a displaced corner, and no other
  vtkPolyData* whole = filter->GetOutput();
  vtkDataArray* zone = whole->GetPointData()->GetArray("Zone");
  vtkIdType expected = 0;
  whole->BuildCells();
  for (vtkIdType cell = 0; cell < whole->GetNumberOfCells(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    whole->GetCellPoints(cell, size, ids);
    expected +=
      std::any_of(ids, ids + size, [&](vtkIdType id) { return zone->GetTuple1(id) > 0.0; }) ? 1 : 0;
  }
  EXPECT_EQ(patch->GetNumberOfPolys(), expected);
}

TEST(DeformFilter, RefusesWhatIsNotATriangleSurface)
{
  vtkNew<CountErrors> errors;
  vtkNew<vtkPalpDeformFilter> filter;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  vtkNew<vtkPolyData> empty;
  filter->SetInputData(empty);
  filter->Update();
  EXPECT_EQ(errors->Errors, 1);

  vtkNew<vtkPolyData> square;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 1.0, 0.0);
  points->InsertNextPoint(0.0, 1.0, 0.0);
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell({ 0, 1, 2, 3 });
  square->SetPoints(points);
  square->SetPolys(polys);
  filter->SetInputData(square);
  filter->Update();
  EXPECT_EQ(errors->Errors, 2);

  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(square);
  filter->SetInputConnection(triangles->GetOutputPort());
  filter->Update();
  EXPECT_EQ(errors->Errors, 2);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 2);
}

} // namespace
} // namespace palp
