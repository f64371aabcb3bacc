#include "pipeline/charts/vtkPalpLineCapture.h"

#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
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
