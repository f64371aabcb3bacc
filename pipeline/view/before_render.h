#pragma once

#include <functional>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkRenderer;

namespace palp
{

/// Calls a function before each picture of a renderer, as long as this lives: for what has its
/// place in pixels, or follows the camera.
class BeforeRender
{
public:
  /// @param layOut  gets the width and height of the picture and the size of a pixel's worth of
  ///               layout, which is more than 1 on a screen of many dots per inch [pixels]
  BeforeRender(
    vtkRenderer& renderer, std::function<void(double width, double height, double scale)> layOut);
  ~BeforeRender();
  BeforeRender(const BeforeRender&) = delete;
  BeforeRender& operator=(const BeforeRender&) = delete;

private:
  vtkSmartPointer<vtkRenderer> renderer_;
  std::function<void(double, double, double)> layOut_;
  vtkNew<vtkCallbackCommand> command_;
};

} // namespace palp
