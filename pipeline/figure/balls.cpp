#include "pipeline/figure/balls.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

namespace palp
{

void Balls::show(const std::vector<Ball>& balls)
{
  constexpr int kResolution = 32;
  for (const auto& actor : actors_)
  {
    renderer_.RemoveActor(actor);
  }
  actors_.clear();
  for (const Ball& ball : balls)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(ball.radius);
    sphere->SetThetaResolution(kResolution);
    sphere->SetPhiResolution(kResolution);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    const auto& actor = actors_.emplace_back(vtkSmartPointer<vtkActor>::New());
    actor->SetMapper(mapper);
    actor->SetPosition(ball.center.x(), ball.center.y(), ball.center.z());
    actor->PickableOff();
    appearance::setColor(*actor->GetProperty(), ball.color);
    renderer_.AddActor(actor);
  }
}

} // namespace palp
