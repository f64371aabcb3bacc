#include "pipeline/figure/surroundings.h"

#include <algorithm>
#include <utility>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

vtkSmartPointer<vtkActor> actorOf(vtkPolyData* surface)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SplittingOff();
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetSpecular(0.2);
  actor->GetProperty()->SetSpecularPower(40.0);
  return actor;
}

} // namespace

Surroundings::Surroundings(vtkRenderer& renderer)
  : renderer_(renderer)
{
}

void Surroundings::show(std::vector<Surrounding> all)
{
  constexpr double kTranslucent = 0.3;
  // what lies behind is drawn before what it is seen through
  std::stable_partition(
    all.begin(), all.end(), [](const Surrounding& one) { return !one.isTranslucent; });
  std::map<vtkPolyData*, vtkSmartPointer<vtkActor>> before = std::exchange(actors_, {});
  for (const auto& [surface, actor] : before)
  {
    renderer_.RemoveActor(actor);
  }
  box_.Reset();
  for (const Surrounding& one : all)
  {
    const auto known = before.find(one.surface);
    const auto actor = known != before.end() ? known->second : actorOf(one.surface);
    vtkProperty& property = *actor->GetProperty();
    appearance::setColor(property, one.color);
    property.SetOpacity(one.isTranslucent ? kTranslucent : 1.0);
    property.SetBackfaceCulling(one.isClosed);
    renderer_.AddActor(actor);
    actors_.emplace(one.surface, actor);
    box_.AddBounds(one.surface->GetBounds());
  }
}

} // namespace palp
