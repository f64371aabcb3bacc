/**
 * @class   vtkPalpLineCapture
 * @brief   lines and text of a render window, written to a file
 *
 * As vtkGL2PSExporter, but without the image of the whole window that it puts behind them, in a PDF
 * of charts most of the file.
 */

#pragma once

#include <cstdio>
#include <string>
#include <vtkOpenGLGL2PSHelperImpl.h>

class vtkPalpLineCapture : public vtkOpenGLGL2PSHelperImpl
{
public:
  static vtkPalpLineCapture* New();
  vtkTypeMacro(vtkPalpLineCapture, vtkOpenGLGL2PSHelperImpl);

  /**
   * Renders the window into an open file, and flushes it.
   * @param format  GL2PS_SVG, or GL2PS_PDF, which gets text as paths: a PDF's own fonts have no
   *                Greek letters
   */
  void Write(vtkRenderWindow* window, int format, FILE* file);

protected:
  vtkPalpLineCapture() = default;
  ~vtkPalpLineCapture() override = default;

  /**
   * Also what is not ASCII, which the superclass leaves out of a path.
   */
  void DrawString(const std::string& text, vtkTextProperty* property, double position[3],
    double backgroundDepth, vtkRenderer* renderer) override;

private:
  vtkPalpLineCapture(const vtkPalpLineCapture&) = delete;
  void operator=(const vtkPalpLineCapture&) = delete;
};
