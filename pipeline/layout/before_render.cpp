#include "pipeline/layout/before_render.h"

#include <utility>
#include <vtkInformation.h>
#include <vtkInformationDoubleKey.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

vtkInformationDoubleKey* footKey()
{
  static auto* key = vtkInformationDoubleKey::MakeKey("Foot", "palp"); // the toolkit deletes it
  return key;
}

double footOf(vtkRenderer& renderer)
{
  vtkInformation& known = *renderer.GetInformation();
  return known.Has(footKey()) ? known.Get(footKey()) : 0.0;
}

} // namespace

void setFoot(vtkRenderer& renderer, double height)
{
  renderer.GetInformation()->Set(footKey(), height);
}

BeforeRender::BeforeRender(
  vtkRenderer& renderer, std::function<void(const PictureRoom& room)> layOut)
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
        self.layOut_({ .width = static_cast<double>(size[0]),
          .height = static_cast<double>(size[1]),
          .foot = footOf(*self.renderer_),
          .scale = window->GetDPI() / kDpi });
      }
    });
  renderer_->AddObserver(vtkCommand::StartEvent, command_);
}

BeforeRender::~BeforeRender()
{
  renderer_->RemoveObserver(command_);
}

} // namespace palp
