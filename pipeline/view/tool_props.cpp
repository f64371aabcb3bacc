#include "pipeline/view/tool_props.h"

#include "haptics/units.h"
#include "pipeline/model/tool_surface.h"
#include "pipeline/view/appearance.h"

#include <algorithm>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

using namespace units::literals;

} // namespace

ToolProps::ToolProps(vtkRenderer& renderer)
{
  constexpr double kSharp = 40.0; // [degrees]
  edges_->SetInputConnection(joined_->GetOutputPort());
  edges_->SetCamera(renderer.GetActiveCamera());
  edges_->SetProp3D(lines_.front());
  edges_->SetEnableFeatureAngle(1);
  edges_->SetFeatureAngle(kSharp);
  for (const bool isLight : { false, true })
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(edges_->GetOutputPort());
    appearance::drawInFront(*mapper);
    isLight ? mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-8.0, -400.0) : void();
    vtkActor& line = *lines_[isLight ? 1 : 0];
    line.SetMapper(mapper);
    line.GetProperty()->LightingOff();
    line.GetProperty()->SetLineWidth(isLight ? 1.5F : 4.0F);
    appearance::setColor(*line.GetProperty(), isLight ? appearance::kPaper : appearance::kInk);
    line.PickableOff();
    renderer.AddActor(&line);
  }
  // behind the surface that lies on it
  mapper_->SetResolveCoincidentTopologyToPolygonOffset();
  mapper_->SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 8.0);
  glass_->SetMapper(mapper_);
  appearance::setColor(*glass_->GetProperty(), appearance::kTool);
  glass_->GetProperty()->SetOpacity(0.25); // the dent is seen through it
  glass_->GetProperty()->BackfaceCullingOn();
  glass_->GetProperty()->SetSpecular(0.6);
  glass_->GetProperty()->SetSpecularPower(40.0);
  renderer.AddActor(glass_);
  show();
}

double ToolProps::heightOf(const Tip& tip)
{
  return std::max(2.2 * baseRadius(tip), 20.0_mm);
}

void ToolProps::setTip(const Tip& tip)
{
  const auto surface = toolSurface(tip, heightOf(tip));
  mapper_->SetInputData(surface);
  joined_->SetInputData(surface);
}

void ToolProps::setLook(ToolLook look)
{
  look_ = look;
  show();
}

void ToolProps::place(const ToolPose& pose)
{
  isKnown_ = pose.apex.allFinite() && pose.axis.allFinite();
  show();
  if (isKnown_)
  {
    const auto there = appearance::placement(pose.apex, appearance::axesAlong(-pose.axis, 2));
    for (vtkActor* actor : { glass_.Get(), lines_[0].Get(), lines_[1].Get() })
    {
      actor->SetUserMatrix(there);
    }
  }
}

void ToolProps::show()
{
  glass_->SetVisibility(isKnown_ && look_ == ToolLook::Solid);
  for (const auto& line : lines_)
  {
    line->SetVisibility(isKnown_ && look_ == ToolLook::Outlined);
  }
}

} // namespace palp
