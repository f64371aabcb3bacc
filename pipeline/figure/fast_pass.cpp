#include "pipeline/figure/fast_pass.h"

#include <memory>
#include <vtkCameraPass.h>
#include <vtkLightsPass.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkOverlayPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkShaderProgram.h>
#include <vtkTranslucentPass.h>
#include <vtk_glew.h>

namespace palp
{
namespace
{

// the colors of the background, where nothing opaque stands
class BackgroundPass : public vtkRenderPass
{
public:
  vtkTypeMacro(BackgroundPass, vtkRenderPass);
  static BackgroundPass* New();

  void Render(const vtkRenderState* state) override
  {
    vtkRenderer* renderer = state->GetRenderer();
    auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
    if (!quad_)
    {
      quad_ = std::make_unique<vtkOpenGLQuadHelper>(window, kCorners, kColors, "");
    }
    window->GetShaderCache()->ReadyShaderProgram(quad_->Program);
    quad_->Program->SetUniform3f("low", renderer->GetBackground());
    quad_->Program->SetUniform3f("high", renderer->GetBackground2());
    vtkOpenGLState* gl = window->GetState();
    const vtkOpenGLState::ScopedglDepthMask mask(gl);
    const vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
    const vtkOpenGLState::ScopedglDepthFunc depth(gl);
    gl->vtkglDepthMask(GL_FALSE);
    gl->vtkglDisable(GL_BLEND);
    gl->vtkglDepthFunc(GL_LEQUAL);
    quad_->Render();
  }

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    quad_.reset();
    this->Superclass::ReleaseGraphicsResources(window);
  }

private:
  // as deep as can be
  static constexpr const char* kCorners = R"(//VTK::System::Dec
in vec4 ndCoordIn;
in vec2 texCoordIn;
out vec2 place;
void main()
{
  place = texCoordIn;
  gl_Position = vec4(ndCoordIn.xy, 1.0, 1.0);
})";
  static constexpr const char* kColors = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 place;
uniform vec3 low;
uniform vec3 high;
void main()
{
  gl_FragData[0] = vec4(mix(low, high, place.y), 1.0);
})";

  std::unique_ptr<vtkOpenGLQuadHelper> quad_;
};
vtkStandardNewMacro(BackgroundPass);

} // namespace

vtkSmartPointer<vtkRenderPass> fastPass()
{
  vtkNew<vtkRenderPassCollection> parts;
  parts->AddItem(vtkNew<vtkLightsPass>());
  parts->AddItem(vtkNew<vtkOpaquePass>());
  parts->AddItem(vtkNew<BackgroundPass>());
  parts->AddItem(vtkNew<vtkTranslucentPass>());
  parts->AddItem(vtkNew<vtkOverlayPass>());
  vtkNew<vtkSequencePass> all;
  all->SetPasses(parts);
  auto camera = vtkSmartPointer<vtkCameraPass>::New();
  camera->SetDelegatePass(all);
  return camera;
}

} // namespace palp
