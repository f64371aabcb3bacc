#include "pipeline/model/section_face.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <vtkAppendPolyData.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

namespace palp
{
namespace
{

void setBall(vtkSphereSource& ball, double radius)
{
  ball.SetRadius(radius);
  ball.SetThetaResolution(120);
  ball.SetPhiResolution(120);
}

double areaOf(vtkPolyData* face)
{
  vtkNew<vtkMassProperties> mass;
  mass->SetInputData(face);
  return face->GetNumberOfCells() > 0 ? mass->GetSurfaceArea() : 0.0;
}

TEST(SectionFace, IsTheAreaOfTheSectionLessItsHoles)
{
  vtkNew<vtkSphereSource> outer;
  vtkNew<vtkSphereSource> inner;
  setBall(*outer, 1.0);
  setBall(*inner, 0.5);
  vtkNew<vtkAppendPolyData> hollow;
  hollow->AddInputConnection(outer->GetOutputPort());
  hollow->AddInputConnection(inner->GetOutputPort());
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.36, 0.48, 0.8);
  const auto face = sectionFace(hollow->GetOutputPort(), *plane);
  for (const double height : { 0.0, 0.3, 0.7, 1.1 })
  {
    plane->SetOrigin(0.0, 0.0, 0.0);
    plane->Push(height);
    face->Update();
    const double ring =
      std::max(0.0, 1.0 - height * height) - std::max(0.0, 0.25 - height * height);
    EXPECT_NEAR(areaOf(face->GetOutput()), std::numbers::pi * ring, 0.01) << height;
  }
}

} // namespace
} // namespace palp
