#include "app/session/live_bodies.h"

#include "pipeline/model/coarse_mesh.h"

#include <algorithm>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

void addCoarse(SceneBody& body)
{
  constexpr int kMost = 400'000; // triangles that are drawn as they are
  constexpr int kDrawn = 60'000; // of the coarse level, about
  if (body.display != nullptr && body.display->GetNumberOfCells() > kMost)
  {
    body.coarse = coarseMesh(*body.display, kDrawn);
  }
}

} // namespace

SceneBody loadLiveBodies(const ScenePlan& plan)
{
  SceneBody all = loadBodies(plan);
  addCoarse(all);
  std::ranges::for_each(all.organs, addCoarse);
  return all;
}

} // namespace palp
