#include "pipeline/figure/ambient_occlusion.h"

#include <vtkCameraPass.h>
#include <vtkLightsPass.h>
#include <vtkNew.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkOverlayPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkSSAOPass.h>
#include <vtkSequencePass.h>
#include <vtkTranslucentPass.h>

namespace palp
{

vtkSmartPointer<vtkRenderPass> ambientOcclusion(double radius)
{
  vtkNew<vtkCameraPass> opaque; // clears to the background
  opaque->SetDelegatePass(vtkNew<vtkOpaquePass>());
  vtkNew<vtkSSAOPass> occlusion;
  occlusion->SetRadius(radius);
  occlusion->SetBias(0.01 * radius);
  occlusion->SetKernelSize(64);
  occlusion->BlurOn();
  occlusion->SetDelegatePass(opaque);

  vtkNew<vtkRenderPassCollection> parts;
  parts->AddItem(vtkNew<vtkLightsPass>());
  parts->AddItem(occlusion);
  parts->AddItem(vtkNew<vtkTranslucentPass>());
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(parts);
  vtkNew<vtkOpenGLFXAAPass> smooth;
  smooth->SetDelegatePass(sequence);

  vtkNew<vtkRenderPassCollection> all;
  all->AddItem(smooth);
  all->AddItem(vtkNew<vtkOverlayPass>());
  vtkNew<vtkSequencePass> picture;
  picture->SetPasses(all);
  auto camera = vtkSmartPointer<vtkCameraPass>::New();
  camera->SetDelegatePass(picture);
  return camera;
}

} // namespace palp
