#include "pipeline/figure/reach_outline.h"

#include <vtkAppendPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

// of radius 1 m about the origin, across each axis
vtkSmartPointer<vtkActor> makeCircles()
{
  constexpr int kCorners = 96;
  vtkNew<vtkAppendPolyData> circles;
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkNew<vtkRegularPolygonSource> circle;
    circle->SetNumberOfSides(kCorners);
    circle->SetRadius(1.0);
    circle->SetNormal(Eigen::Vector3d::Unit(axis).eval().data());
    circle->GeneratePolygonOff();
    circles->AddInputConnection(circle->GetOutputPort());
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(circles->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->PickableOff();
  actor->UseBoundsOff(); // the view is fitted to the body
  actor->GetProperty()->LightingOff();
  appearance::setColor(*actor->GetProperty(), appearance::kUnknown);
  return actor;
}

} // namespace

bool ReachOutline::show(const Eigen::Vector3d& center, double radius)
{
  if (radius == radius_ && (radius == 0.0 || center == center_))
  {
    return false;
  }
  if (!actor_)
  {
    actor_ = makeCircles();
    renderer_.AddActor(actor_);
  }
  center_ = center;
  radius_ = radius;
  actor_->SetVisibility(radius > 0.0);
  actor_->SetPosition(center.x(), center.y(), center.z());
  actor_->SetScale(radius > 0.0 ? radius : 1.0);
  return true;
}

} // namespace palp
