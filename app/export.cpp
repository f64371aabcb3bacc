#include "app/export.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/surface_io.h"
#include "pipeline/vtkPalpDeformFilter.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <fstream>
#include <system_error>

namespace palp
{

Press pressOf(const Sample& sample, const Tip& tip, const ExtentTable& extents)
{
  return { .contact = sample.contact,
    .pose = sample.pose,
    .tip = tip,
    .contactRadius = sample.response.contactRadius,
    .extentRadius = extents.extentRadius(sample.contact.depth) };
}

void writeDeformed(const std::filesystem::path& file, const Body& body, const Recording& recording,
  const ExtentTable& extents)
{
  vtkNew<vtkPalpDeformFilter> filter;
  filter->SetInputData(body.display);
  if (const Sample* deepest = recording.deepest())
  {
    filter->SetPress(pressOf(*deepest, recording.scene.law.tip(), extents));
  }
  filter->Update();

  // the writer turns the points into millimetres, the displacement is ours to turn
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(filter->GetOutput());
  vtkNew<vtkFloatArray> displacement;
  displacement->DeepCopy(mesh->GetPointData()->GetArray("Displacement"));
  for (vtkIdType i = 0; i < displacement->GetNumberOfValues(); ++i)
  {
    displacement->SetValue(
      i, static_cast<float>(units::toMillimetres(static_cast<double>(displacement->GetValue(i)))));
  }
  displacement->SetName("Displacement");
  mesh->GetPointData()->AddArray(displacement);
  writeSurface(file, *mesh);
}

void exportRecording(const std::filesystem::path& directory, const Body& body,
  const Recording& recording, const ExtentTable& extents)
{
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  const std::filesystem::path file = directory / "samples.csv";
  std::ofstream samples(file);
  writeSamples(samples, recording, extents);
  samples.close();
  if (!samples)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": cannot be written; choose a folder with room where you may write");
  }
  writeDeformed(directory / "deformed.vtp", body, recording, extents);
}

} // namespace palp
