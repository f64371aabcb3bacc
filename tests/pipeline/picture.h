#pragma once

#include "haptics/units.h"
#include "pipeline/view/press_view.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace palp::test
{

inline vtkSmartPointer<vtkImageData> imageOf(vtkRenderWindow& window)
{
  window.Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(&window);
  grab->ReadFrontBufferOff();
  grab->Update();
  return grab->GetOutput();
}

/// How far a picture is from a reference.
struct Difference
{
  double mean = 255.0;  ///< of all channels, 0 to 255
  double changed = 1.0; ///< fraction of pixels with a channel off by more than 48
};

inline Difference differenceOf(vtkImageData& image, vtkImageData& reference)
{
  int size[3];
  int wanted[3];
  image.GetDimensions(size);
  reference.GetDimensions(wanted);
  auto* a = vtkUnsignedCharArray::SafeDownCast(image.GetPointData()->GetScalars());
  auto* b = vtkUnsignedCharArray::SafeDownCast(reference.GetPointData()->GetScalars());
  if (size[0] != wanted[0] || size[1] != wanted[1] || !a || !b ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents())
  {
    return {};
  }
  constexpr int kSeen = 48;
  double sum = 0.0;
  vtkIdType changed = 0;
  const int channels = a->GetNumberOfComponents();
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    bool isChanged = false;
    for (int k = 0; k < channels; ++k)
    {
      const int off =
        std::abs(a->GetTypedComponent(i, k) - static_cast<int>(b->GetTypedComponent(i, k)));
      sum += off;
      isChanged = isChanged || off > kSeen;
    }
    changed += isChanged ? 1 : 0;
  }
  const auto pixels = static_cast<double>(a->GetNumberOfTuples());
  return { .mean = sum / (pixels * channels), .changed = static_cast<double>(changed) / pixels };
}

/// Compares with tests/pipeline/baselines/<name>.png; with PALP_WRITE_BASELINES set writes it
/// there instead, for a person to look at.
inline Difference differenceFromBaseline(vtkImageData& image, const std::string& name)
{
  const std::filesystem::path file =
    std::filesystem::path(PALP_SOURCE_DIR) / "tests/pipeline/baselines" / (name + ".png");
  if (std::getenv("PALP_WRITE_BASELINES"))
  {
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(&image);
    writer->Write();
    return { .mean = 0.0, .changed = 0.0 };
  }
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(file.c_str()))
  {
    return {};
  }
  reader->SetFileName(file.c_str());
  reader->Update();
  return differenceOf(image, *reader->GetOutput());
}

} // namespace palp::test
