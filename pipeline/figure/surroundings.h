#pragma once

#include "pipeline/view/appearance.h"

#include <map>
#include <vector>
#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkSmartPointer.h>

class vtkPolyData;
class vtkRenderer;

namespace palp
{

/// A surface beside the one that is pressed.
struct Surrounding
{
  vtkSmartPointer<vtkPolyData> surface{}; ///< [m]; shared, not copied
  appearance::Color color = appearance::kLiver;
  bool isTranslucent = false; ///< what lies behind is seen
  bool isClosed = false;      ///< nobody sees its inside, which is not drawn then
};

/// What is seen around the pressed surface: an actor each, which gives way to nothing.
class Surroundings
{
public:
  explicit Surroundings(vtkRenderer& renderer);

  /// Those and no others.
  void show(std::vector<Surrounding> all);

  /// Of all that is shown [m].
  [[nodiscard]] const vtkBoundingBox& box() const noexcept
  {
    return box_;
  }

private:
  vtkRenderer& renderer_;
  std::map<vtkPolyData*, vtkSmartPointer<vtkActor>> actors_; // each has its surface
  vtkBoundingBox box_;
};

} // namespace palp
