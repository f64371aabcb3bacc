#include "pipeline/charts/vtkPalpLineCapture.h"

#include <algorithm>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPath.h>
#include <vtkRenderWindow.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnicodeString.h>
#include <vtk_gl2ps.h>

vtkStandardNewMacro(vtkPalpLineCapture);

//------------------------------------------------------------------------------
void vtkPalpLineCapture::Write(vtkRenderWindow* window, int format, FILE* file)
{
  constexpr int options =
    GL2PS_SILENT | GL2PS_SIMPLE_LINE_OFFSET | GL2PS_NO_OPENGL_CONTEXT | GL2PS_NO_BLENDING;
  this->SetInstance(this);
  this->SetTextAsPath(format == GL2PS_PDF);
  this->SetRenderWindow(window);
  GLint whole[4] = { 0, 0, window->GetSize()[0], window->GetSize()[1] };
  gl2psBeginPage("palp", "VTK", whole, format, GL2PS_NO_SORT, options, GL_RGBA, 0, nullptr, 0, 0, 0,
    0, file, "");
  this->SetActiveState(vtkOpenGLGL2PSHelper::Capture);
  window->Render();
  this->SetActiveState(vtkOpenGLGL2PSHelper::Inactive);
  gl2psEndPage();
  this->SetInstance(nullptr);
  fflush(file);
}

//------------------------------------------------------------------------------
void vtkPalpLineCapture::DrawString(const std::string& text, vtkTextProperty* property,
  double position[3], double backgroundDepth, vtkRenderer* renderer)
{
  const auto isAscii = [](char letter) { return static_cast<unsigned char>(letter) < 128; };
  if (!this->TextAsPath || std::all_of(text.begin(), text.end(), isAscii))
  {
    this->Superclass::DrawString(text, property, position, backgroundDepth, renderer);
    return;
  }
  vtkNew<vtkPath> path;
#pragma GCC diagnostic push // VTK 9.1 takes no other text whole
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  vtkTextRenderer::GetInstance()->StringToPath(
    property, vtkUnicodeString::from_utf8(text), path, this->RenderWindow->GetDPI());
#pragma GCC diagnostic pop
  unsigned char color[4] = { 0, 0, 0, static_cast<unsigned char>(255 * property->GetOpacity()) };
  for (int i = 0; i < 3; ++i)
  {
    color[i] = static_cast<unsigned char>(255 * property->GetColor()[i]);
  }
  this->DrawPath(path, position, position, color);
}
