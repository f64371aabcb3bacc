#include "pipeline/figure/other_hand.h"

#include <limits>
#include <utility>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

bool isDented(const Sample& first, const Sample* other)
{
  return other != nullptr && other->organ == first.organ;
}

} // namespace

OtherHand::Props::Props(vtkRenderer& renderer, vtkProperty& surface)
  : dent(renderer, *press, &surface)
  , tool(renderer)
{
  dent.setLegend(false); // that of the first hand tells of both
}

void OtherHand::show(const Sample& first, const Sample* other)
{
  if (other != nullptr && !props_)
  {
    props_ = std::make_unique<Props>(renderer_, view_.surfaceProperty());
    view_.press().SetInputConnection(1, props_->press->GetOutputPort());
  }
  if (!props_)
  {
    view_.show(first);
    return;
  }
  shown_ = other != nullptr ? std::optional(*other) : std::nullopt;
  if (std::exchange(props_->version, view_.version()) != view_.version())
  {
    props_->tool.setTip(view_.tip());
    props_->dent.setBase(view_.color());
  }
  press(first, other);
  view_.show(first);
  placeDent(first, other);
  const Eigen::Vector3d nowhere =
    Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  props_->tool.setLook(view_.look().tool);
  props_->tool.place(other != nullptr ? other->pose : ToolPose{ .apex = nowhere });
}

void OtherHand::press(const Sample& first, const Sample* other)
{
  Sample dented; // touches nothing
  if (isDented(first, other))
  {
    dented = drawnSample(*other, props_->left);
    props_->left = other->contact.touching() ? *other : props_->left;
  }
  vtkPalpDeformFilter& press = *props_->press;
  press.SetInputDataObject(view_.press().GetInput());
  view_.setBeside(view_.loadsOf(dented));
  press.SetPress(view_.drawnPress(dented, view_.loadsOf(first)));
  press.SetGeneratePatch(dented.contact.touching());
  press.Update();
  view_.setDeepestBeside(dented.contact.depth);
}

// in the colors of the first, but those of pressure, which has no range for two
void OtherHand::placeDent(const Sample& first, const Sample* other)
{
  if (!view_.drawsDentsApart() || !isDented(first, other) || !other->contact.touching())
  {
    props_->dent.hide();
    return;
  }
  const OverlayState state{ *other, view_.tip(), props_->press->GetPress().extentRadius,
    *props_->press };
  const DentColors::By by = view_.colors();
  props_->dent.show(
    state, by == DentColors::By::Displacement ? by : DentColors::By::Nothing, first.contact.depth);
  view_.cut(*props_->dent.mapper());
}

} // namespace palp
