#pragma once

#include "pipeline/layout/before_render.h"

#include <vtkSmartPointer.h>

class vtkRenderPass;
class vtkRenderer;

namespace palp
{

/// The body wet, lit by a studio, and darker where little light comes: for graphics cards, and
/// for pictures that may take a second.
class Realism
{
public:
  /// Off at first.
  /// @param renderer  outlives this object
  explicit Realism(vtkRenderer& renderer);
  ~Realism();
  Realism(const Realism&) = delete;
  Realism& operator=(const Realism&) = delete;

  /// @param size  of the body [m]
  void turnOn(double size);

  /// The renderer is as before, with no pass of its own.
  void turnOff();

  [[nodiscard]] bool isOn() const noexcept
  {
    return pass_ != nullptr;
  }

private:
  vtkRenderer& renderer_;
  vtkSmartPointer<vtkRenderPass> pass_; // null: off
  BeforeRender layOut_;                 // what came into the picture since
};

} // namespace palp
