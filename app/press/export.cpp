#include "app/press/export.h"

#include "haptics/files/csv_text.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"
#include "pipeline/deform/press_of.h"
#include "pipeline/deform/refined_surface.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "pipeline/surface_io/surface_io.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <array>
#include <chrono>
#include <sstream>
#include <string>

namespace palp
{

Press pressOf(const Sample& sample, const Tip& tip, const Calibration& calibration)
{
  return pressOf(
    sample, tip, [&](double depth) { return calibration.extents.extentRadius(depth); },
    calibration.style);
}

void writeDeformed(const std::filesystem::path& file, const SceneBody& body,
  const Recording& recording, const Calibration& calibration, bool refined)
{
  const Sample* deepest = recording.deepest();
  const int organ = deepest != nullptr ? deepest->organ : 0;
  vtkNew<vtkPalpDeformFilter> filter;
  filter->SetInputData(body.felt(recording.organs, organ).display);
  filter->SetGeneratePatch(refined);
  filter->SetPatchTolerance(units::fromMillimeters(0.01));
  if (deepest != nullptr)
  {
    filter->SetPress(pressOf(*deepest, recording.scene.law.tip(), organOf(calibration, organ)));
  }
  filter->Update();

  // the writer turns the points into millimeters, the displacement is ours to turn
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(refined ? refinedSurface(*filter).Get() : filter->GetOutput());
  vtkNew<vtkFloatArray> displacement;
  displacement->DeepCopy(mesh->GetPointData()->GetArray("Displacement"));
  for (vtkIdType i = 0; i < displacement->GetNumberOfValues(); ++i)
  {
    displacement->SetValue(
      i, static_cast<float>(units::toMillimeters(static_cast<double>(displacement->GetValue(i)))));
  }
  displacement->SetName("Displacement");
  mesh->GetPointData()->AddArray(displacement);
  writeSurface(file, *mesh, spaceOf(body.felt(recording.organs, organ).files));
}

void writeSamples(
  const std::filesystem::path& file, const Recording& recording, const Calibration* calibration)
{
  std::ostringstream out;
  writeSamples(out, recording, calibration);
  replaceFile(file, out.view());
}

void writeTiming(const std::filesystem::path& file, const Timing& timing)
{
  using Micro = std::chrono::duration<double, std::micro>;
  std::ostringstream out;
  out << "quantity,p50_us,p99_us,p999_us,max_us,ticks,skipped\n";
  for (const auto& [name, histogram] :
    { std::pair("lateness", &timing.lateness), std::pair("step", &timing.step) })
  {
    out << name << ',';
    writeCsvRow(out,
      std::array{ Micro(histogram->quantile(0.5)).count(), Micro(histogram->quantile(0.99)).count(),
        Micro(histogram->quantile(0.999)).count(), Micro(histogram->longest()).count(),
        static_cast<double>(timing.ticks.load()), static_cast<double>(timing.skipped.load()) });
  }
  replaceFile(file, out.view());
}

} // namespace palp
