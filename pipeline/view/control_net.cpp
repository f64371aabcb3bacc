#include "pipeline/view/control_net.h"

#include "pipeline/view/appearance.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace palp
{

ControlNet::ControlNet(vtkRenderer& renderer)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(net_);
  appearance::drawInFront(*mapper);
  actor_->SetMapper(mapper);
  appearance::setColor(*actor_->GetProperty(), appearance::kNet);
  actor_->GetProperty()->SetLineWidth(1.5F);
  actor_->GetProperty()->SetPointSize(6.0F);
  actor_->GetProperty()->LightingOff();
  renderer.AddActor(actor_);
  ControlNet::hide();
}

void ControlNet::show(const OverlayState& state)
{
  fillControlNet(state.press.GetDent(), *net_);
  for (vtkIdType i = 0; i < net_->GetNumberOfPoints(); ++i)
  {
    const Eigen::Vector3d point(net_->GetPoint(i));
    net_->GetPoints()->SetPoint(i, state.press.WithBody(point, point).eval().data());
  }
  actor_->VisibilityOn();
}

void ControlNet::hide()
{
  actor_->VisibilityOff();
}

void fillControlNet(const Dent& dent, vtkPolyData& net)
{
  constexpr vtkIdType kRow = 3;
  constexpr vtkIdType kCount = kRow * PressField::kDirections;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkCellArray> dots;
  for (int k = 0; k < PressField::kDirections; ++k)
  {
    for (const Eigen::Vector3d& point : dent.field().controlPoints(k, dent.region()))
    {
      dots->InsertNextCell({ points->InsertNextPoint(point.data()) });
    }
    const vtkIdType first = kRow * k;
    lines->InsertNextCell({ first, first + 1, first + 2 });
    for (vtkIdType i = first; i < first + kRow; ++i)
    {
      lines->InsertNextCell({ i, (i + kRow) % kCount });
    }
  }
  net.SetPoints(points);
  net.SetLines(lines);
  net.SetVerts(dots);
}

} // namespace palp
