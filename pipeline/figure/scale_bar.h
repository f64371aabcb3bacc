#pragma once

#include "pipeline/layout/before_render.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTextActor.h>

class vtkRenderer;

namespace palp
{

/// A bar of round length, true as far away as the contact, or else as what the eye looks at: nearer
/// things are larger.
class ScaleBar
{
public:
  /// It is not shown at first.
  explicit ScaleBar(vtkRenderer& renderer);

  void setVisible(bool visible);

  /// At first dark, as for a light picture.
  void setInk(const std::array<double, 3>& ink);

  /// @param contact  from now on [m]; none: there was none
  void setPlace(const std::optional<Eigen::Vector3d>& contact);

  /// Its length as last drawn [m].
  [[nodiscard]] double length() const noexcept
  {
    return length_;
  }

private:
  void place(vtkRenderer& renderer, const PictureRoom& room);

  vtkRenderer& renderer_;
  std::optional<Eigen::Vector3d> contact_{}; // [m]
  double length_ = 0.0;
  vtkNew<vtkPolyData> bar_; // [pixels]
  vtkNew<vtkActor2D> actor_;
  vtkNew<vtkTextActor> text_;
  BeforeRender layOut_;
};

} // namespace palp
