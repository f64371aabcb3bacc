#include "pipeline/view/iso_lines.h"

#include "haptics/units.h"
#include "pipeline/model/level_lines.h"
#include "pipeline/view/appearance.h"

#include <cmath>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace palp
{

IsoLines::IsoLines(vtkRenderer& renderer)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(lines_);
  mapper->ScalarVisibilityOff();
  appearance::drawInFront(*mapper);
  actor_->SetMapper(mapper);
  appearance::setColor(*actor_->GetProperty(), appearance::kInk);
  actor_->GetProperty()->LightingOff();
  renderer.AddActor(actor_);
  IsoLines::hide();
}

double IsoLines::stepOf(double depth) noexcept
{
  constexpr double kMost = 8.0; // lines
  const double least = depth / kMost;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : { 1.0, 2.0, 5.0 })
  {
    if (step * power >= (1.0 - 1e-9) * least)
    {
      return step * power;
    }
  }
  return 10.0 * power;
}

void IsoLines::show(const OverlayState& state)
{
  const double depth = state.sample.contact.depth;
  const double step = stepOf(depth);
  const int count = static_cast<int>(std::ceil(depth / step - 1e-9)) - 1; // the deepest is a point
  vtkPolyData& patch = *vtkPolyData::SafeDownCast(state.press.GetOutputDataObject(1));
  lines_->Initialize();
  for (int i = 1; i <= count; ++i)
  {
    addLevelLines(patch, state.press.GetPatch().triangles, "Displacement [mm]", "Displacement",
      static_cast<float>(units::toMillimeters(i * step)), *lines_);
  }
  actor_->SetVisibility(count > 0);
}

void IsoLines::hide()
{
  actor_->VisibilityOff();
}

} // namespace palp
