#pragma once

#include <memory>
#include <vtkSmartPointer.h>

class vtkGenericOpenGLRenderWindow;

namespace palp
{

/// An OpenGL context without any display server, through EGL's surfaceless platform.
///
/// Debian's VTK can open windows on X only; this makes pictures where there is none.
class OffscreenContext
{
public:
  /// @throws Error  NoPicture: no EGL, or no OpenGL 3.2 behind it
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// A render window that draws in this context and must not outlive it.
  [[nodiscard]] vtkSmartPointer<vtkGenericOpenGLRenderWindow> makeWindow(
    int width, int height) const;

private:
  struct Egl;
  std::unique_ptr<Egl> egl_;
};

} // namespace palp
