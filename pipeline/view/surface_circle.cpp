#include "pipeline/view/surface_circle.h"

#include "pipeline/model/level_lines.h"
#include "pipeline/view/appearance.h"

#include <algorithm>
#include <cmath>
#include <vector>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

constexpr double kSame = 0.01; // [-] of the radius: the point faces the tool, its way is straight

} // namespace

SurfaceCircle::SurfaceCircle(vtkRenderer& renderer, Of of)
  : of_(of)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(line_);
  mapper->ScalarVisibilityOff();
  appearance::drawInFront(*mapper);
  actor_->SetMapper(mapper);
  appearance::setColor(
    *actor_->GetProperty(), of == Of::Contact ? appearance::kContact : appearance::kExtent);
  actor_->GetProperty()->SetLineWidth(3.0F);
  actor_->GetProperty()->LightingOff();
  renderer.AddActor(actor_);
  SurfaceCircle::hide();
}

void SurfaceCircle::show(const OverlayState& state)
{
  const double radius =
    of_ == Of::Contact ? state.press.GetPress().contactRadius : state.extentRadius;
  line_->Initialize();
  addLevelLines(*vtkPolyData::SafeDownCast(state.press.GetOutputDataObject(1)),
    state.press.GetPatch().triangles, "Distance", "Displacement", static_cast<float>(radius),
    *line_);
  state.press.GetPress().motion ? void() : putOnField(state.press.GetDent(), radius);
  actor_->SetVisibility(radius > 0.0);
}

// the line crosses triangles, and at a steep wall those are far from the field between their
// corners; around a ridge the contact has no line, for there the tool does not follow the surface
void SurfaceCircle::putOnField(const Dent& dent, double radius)
{
  const auto* moved = vtkFloatArray::SafeDownCast(line_->GetPointData()->GetArray("Displacement"));
  if (!moved)
  {
    return;
  }
  vtkNew<vtkPoints> points;
  points->DeepCopy(line_->GetPoints());
  std::vector<bool> isInFront(static_cast<std::size_t>(points->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Eigen::Vector3d rest(points->GetPoint(i));
    for (int k = 0; k < 3; ++k)
    {
      rest[k] -= moved->GetTypedComponent(i, k);
    }
    const GeodesicCoordinates geodesic = dent.region().geodesicInFront(rest);
    if (std::abs(geodesic.distance - radius) < kSame * radius)
    {
      isInFront[static_cast<std::size_t>(i)] = true;
      rest += dent.displacement(geodesic, dent.sinkAt(geodesic, rest).depth);
      points->SetPoint(i, rest.data());
    }
  }
  line_->SetPoints(points);
  if (of_ == Of::Contact)
  {
    vtkNew<vtkCellArray> kept;
    vtkNew<vtkIdList> ends;
    for (vtkIdType i = 0; i < line_->GetNumberOfLines(); ++i)
    {
      line_->GetLines()->GetCellAtId(i, ends);
      const auto isFront = [&](vtkIdType point)
      { return isInFront[static_cast<std::size_t>(point)]; };
      if (std::all_of(ends->begin(), ends->end(), isFront))
      {
        kept->InsertNextCell(ends);
      }
    }
    line_->SetLines(kept);
  }
}

void SurfaceCircle::hide()
{
  actor_->VisibilityOff();
}

} // namespace palp
