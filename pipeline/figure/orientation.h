#pragma once

#include "pipeline/layout/before_render.h"

#include <array>
#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTextActor.h>

class vtkRenderer;

namespace palp
{

/// The axes of the scene in a corner of the picture, as the eye has them: the patient's sides by
/// their letters, or x, y and z where nobody knows the patient's.
class Orientation
{
public:
  explicit Orientation(vtkRenderer& renderer);

  /// @param isPatient  the coordinates are LPS: x to the left, y to the back, z to the head
  void setPatient(bool isPatient);

  void setVisible(bool visible);

  /// At first dark, as for a light picture.
  void setInk(const std::array<double, 3>& ink);

private:
  void place(vtkRenderer& renderer, const PictureRoom& room);

  static constexpr std::size_t kEnds = 6; // +x, -x, +y, -y, +z, -z

  bool isVisible_ = true;
  bool isPatient_ = false;
  std::array<vtkNew<vtkTextActor>, kEnds> letters_;
  vtkNew<vtkPolyData> lines_; // [pixels]
  vtkNew<vtkActor2D> cross_;
  BeforeRender layOut_;
};

} // namespace palp
