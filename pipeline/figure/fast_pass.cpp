#include "pipeline/figure/fast_pass.h"

#include <vtkCameraPass.h>
#include <vtkLightsPass.h>
#include <vtkNew.h>
#include <vtkOpaquePass.h>
#include <vtkOverlayPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkSequencePass.h>
#include <vtkTranslucentPass.h>

namespace palp
{

vtkSmartPointer<vtkRenderPass> fastPass()
{
  vtkNew<vtkRenderPassCollection> parts;
  parts->AddItem(vtkNew<vtkLightsPass>());
  parts->AddItem(vtkNew<vtkOpaquePass>());
  parts->AddItem(vtkNew<vtkTranslucentPass>());
  parts->AddItem(vtkNew<vtkOverlayPass>());
  vtkNew<vtkSequencePass> all;
  all->SetPasses(parts);
  auto camera = vtkSmartPointer<vtkCameraPass>::New();
  camera->SetDelegatePass(all);
  return camera;
}

} // namespace palp
