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

vtkInformationDoubleKey* marksKey()
{
  static auto* key = vtkInformationDoubleKey::MakeKey("Marks", "palp");
  return key;
}

double known(vtkRenderer& renderer, vtkInformationDoubleKey* key)
{
  vtkInformation& all = *renderer.GetInformation();
  return all.Has(key) ? all.Get(key) : 0.0;
}

} // namespace

void setFoot(vtkRenderer& renderer, double height)
{
  renderer.GetInformation()->Set(footKey(), height);
}

void setMarks(vtkRenderer& renderer, double width)
{
  renderer.GetInformation()->Set(marksKey(), width);
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
        const double scale = window->GetDPI() / kDpi;
        self.layOut_({ .width = static_cast<double>(size[0]),
          .height = static_cast<double>(size[1]),
          .foot = known(*self.renderer_, footKey()),
          .scale = scale,
          .marks = scale * known(*self.renderer_, marksKey()) });
      }
    });
  renderer_->AddObserver(vtkCommand::StartEvent, command_);
}

BeforeRender::~BeforeRender()
{
  renderer_->RemoveObserver(command_);
}

} // namespace palp
