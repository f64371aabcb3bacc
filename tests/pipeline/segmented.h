#pragma once

#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkImageStencil.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataToImageStencil.h>
#include <vtkSmartPointer.h>
#include <vtkWindowedSincPolyDataFilter.h>

namespace palp::test
{

/// A body as a scanner would give it: in voxels, contoured and smoothed.
/// @param voxel  side [m]
inline vtkSmartPointer<vtkPolyData> contouredFromVoxels(vtkPolyData& body, double voxel)
{
  const double* box = body.GetBounds();
  vtkNew<vtkImageData> image;
  image->SetSpacing(voxel, voxel, voxel);
  image->SetOrigin(box[0] - 3.0 * voxel, box[2] - 3.0 * voxel, box[4] - 3.0 * voxel);
  const auto cells = [&](int axis)
  { return static_cast<int>((box[2 * axis + 1] - box[2 * axis]) / voxel) + 7; };
  image->SetDimensions(cells(0), cells(1), cells(2));
  image->AllocateScalars(VTK_FLOAT, 1);
  image->GetPointData()->GetScalars()->Fill(1.0);
  vtkNew<vtkPolyDataToImageStencil> inside;
  inside->SetInputData(&body);
  inside->SetOutputOrigin(image->GetOrigin());
  inside->SetOutputSpacing(image->GetSpacing());
  inside->SetOutputWholeExtent(image->GetExtent());
  vtkNew<vtkImageStencil> mask;
  mask->SetInputData(image);
  mask->SetStencilConnection(inside->GetOutputPort());
  mask->SetBackgroundValue(0.0);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputConnection(mask->GetOutputPort());
  contour->SetValue(0, 0.5);
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputConnection(contour->GetOutputPort());
  smooth->SetNumberOfIterations(15);
  smooth->Update();
  return smooth->GetOutput();
}

} // namespace palp::test
