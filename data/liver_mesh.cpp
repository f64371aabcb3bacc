#include "data/liver_mesh.h"

#include "data/liver.h"
#include "data/remesh.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"

#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

const Vector3d kCorner(-125.0_mm, -55.0_mm, -90.0_mm); // of a box that holds the liver
constexpr double kSpacing = 2.0_mm;                    // finer than the notches
constexpr int kSamples[3] = { 126, 56, 91 };

} // namespace

Mesh makeLiver(double edge)
{
  vtkNew<vtkImageData> samples;
  samples->SetDimensions(kSamples);
  samples->SetOrigin(kCorner.data());
  samples->SetSpacing(kSpacing, kSpacing, kSpacing);
  samples->AllocateScalars(VTK_DOUBLE, 1);
  auto* sample = static_cast<double*>(samples->GetScalarPointer());
  for (int k = 0; k < kSamples[2]; ++k)
  {
    for (int j = 0; j < kSamples[1]; ++j)
    {
      for (int i = 0; i < kSamples[0]; ++i)
      {
        *sample++ = -liverDistance(kCorner + kSpacing * Vector3d(i, j, k));
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
  return remesh({ pointsOf(output), trianglesOf(output) }, edge, liverDistance);
}

} // namespace palp
