#include "pipeline/figure/realism.h"

#include "pipeline/figure/ambient_occlusion.h"
#include "pipeline/figure/studio.h"

#include <vtkRenderPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace palp
{

Realism::Realism(vtkRenderer& renderer)
  : renderer_(renderer)
  , layOut_(renderer, [this](const PictureRoom&) { isOn() ? makePhysical(renderer_) : void(); })
{
}

Realism::~Realism()
{
  turnOff();
}

void Realism::turnOn(double size)
{
  constexpr double kReach = 0.08; // of the body
  turnOff();
  addStudio(renderer_);
  pass_ = ambientOcclusion(kReach * size);
  renderer_.SetPass(pass_);
}

void Realism::turnOff()
{
  if (!isOn())
  {
    return;
  }
  removeStudio(renderer_);
  renderer_.SetPass(nullptr);
  if (vtkRenderWindow* window = renderer_.GetRenderWindow())
  {
    window->MakeCurrent();
    pass_->ReleaseGraphicsResources(window);
  }
  pass_ = nullptr;
}

} // namespace palp
