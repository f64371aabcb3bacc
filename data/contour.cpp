#include "data/contour.h"

#include "data/remesh.h"
#include "pipeline/model/poly_data.h"

#include <array>
#include <cmath>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace palp
{

Mesh contoured(const Distance& distance, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
  double spacing, double edge)
{
  const Eigen::Array3i size =
    ((high - low) / spacing).array().round().cast<int>() + Eigen::Array3i::Ones();
  vtkNew<vtkImageData> samples;
  samples->SetDimensions(size.data());
  samples->SetOrigin(low.data());
  samples->SetSpacing(spacing, spacing, spacing);
  samples->AllocateScalars(VTK_DOUBLE, 1);
  auto* sample = static_cast<double*>(samples->GetScalarPointer());
  for (int k = 0; k < size.z(); ++k)
  {
    for (int j = 0; j < size.y(); ++j)
    {
      for (int i = 0; i < size.x(); ++i)
      {
        *sample++ = -distance(low + spacing * Eigen::Vector3d(i, j, k));
      }
    }
  }
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(samples);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();

  vtkPolyData& output = *contour->GetOutput();
  return remesh({ pointsOf(output), trianglesOf(output) }, edge, distance);
}

} // namespace palp
