#include "app/draw/offscreen.h"

#include "haptics/error.h"

#include <vtk_glew.h>

#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <dlfcn.h>
#include <string>

// Debian's GLEW is built for X: without a display its glewInit reports GLEW_ERROR_NO_GLX_DISPLAY,
// though by then every entry point is loaded. The program's own symbol wins over the library's.
extern "C" GLenum glewInit()
{
  constexpr GLenum kNoGlxDisplay = 4;
  using Init = GLenum (*)();
  const auto original = reinterpret_cast<Init>(dlsym(RTLD_NEXT, "glewInit"));
  const GLenum result = original ? original() : GLenum{ 1 };
  return result == kNoGlxDisplay ? GLenum{ 0 } : result;
}

namespace palp
{
namespace
{

[[noreturn]] void refuse(const std::string& what)
{
  throw Error(ErrorCode::NoPicture,
    "picture: " + what + "; install libegl1 and libgl1-mesa-dri, or pass --no-picture");
}

// VTK asks before each frame whether its context is current; here it always is
void alwaysCurrent(vtkObject*, unsigned long, void*, void* answer)
{
  *static_cast<bool*>(answer) = true;
}

} // namespace

struct OffscreenContext::Egl
{
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;

  ~Egl()
  {
    if (display != EGL_NO_DISPLAY)
    {
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglTerminate(display);
    }
  }
};

OffscreenContext::OffscreenContext()
  : egl_(std::make_unique<Egl>())
{
  const auto getDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
    eglGetProcAddress("eglGetPlatformDisplayEXT"));
  egl_->display = getDisplay
    ? getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)
    : EGL_NO_DISPLAY;
  if (egl_->display == EGL_NO_DISPLAY || !eglInitialize(egl_->display, nullptr, nullptr))
  {
    refuse("no off-screen EGL display");
  }
  eglBindAPI(EGL_OPENGL_API);

  constexpr std::array<EGLint, 13> kWanted{ EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
    EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_DEPTH_SIZE, 24,
    EGL_NONE };
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(egl_->display, kWanted.data(), &config, 1, &count) || count == 0)
  {
    refuse("no EGL configuration with OpenGL");
  }

  // VTK draws into framebuffer objects of its own; the surface only makes the context complete
  constexpr std::array<EGLint, 5> kTiny{ EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE };
  egl_->surface = eglCreatePbufferSurface(egl_->display, config, kTiny.data());
  constexpr std::array<EGLint, 7> kCore{ EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2,
    EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
  egl_->context = eglCreateContext(egl_->display, config, EGL_NO_CONTEXT, kCore.data());
  if (egl_->context == EGL_NO_CONTEXT ||
    !eglMakeCurrent(egl_->display, egl_->surface, egl_->surface, egl_->context))
  {
    refuse("no OpenGL 3.2 context");
  }
}

OffscreenContext::~OffscreenContext() = default;

vtkSmartPointer<vtkGenericOpenGLRenderWindow> OffscreenContext::makeWindow(
  int width, int height) const
{
  auto window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
  window->SetSize(width, height);
  window->SetReadyForRendering(true);
  window->SetSupportsOpenGL(1);
  window->SetIsDirect(1);
  window->SetIsCurrent(true);
  window->SetMapped(1);
  window->SetMultiSamples(0);
  vtkNew<vtkCallbackCommand> current;
  current->SetCallback(alwaysCurrent);
  window->AddObserver(vtkCommand::WindowIsCurrentEvent, current);
  window->OpenGLInitContext();
  window->OpenGLInit();
  return window;
}

} // namespace palp
