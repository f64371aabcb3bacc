#include "pipeline/view/before_render.h"

#include "pipeline/view/appearance.h"

#include <utility>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace palp
{

BeforeRender::BeforeRender(
  vtkRenderer& renderer, std::function<void(double width, double height, double scale)> layOut)
  : renderer_(&renderer)
  , layOut_(std::move(layOut))
{
  command_->SetClientData(this);
  command_->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*)
    {
      auto& self = *static_cast<BeforeRender*>(data);
      const int* size = self.renderer_->GetSize();
      if (vtkRenderWindow* window = self.renderer_->GetRenderWindow(); window && size[0] > 0)
      {
        self.layOut_(size[0], size[1], window->GetDPI() / appearance::kDpi);
      }
    });
  renderer_->AddObserver(vtkCommand::StartEvent, command_);
}

BeforeRender::~BeforeRender()
{
  renderer_->RemoveObserver(command_);
}

} // namespace palp
