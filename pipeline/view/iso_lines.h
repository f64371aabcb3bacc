#pragma once

#include "pipeline/view/overlay_props.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace palp
{

/// Lines on the dent through places that moved as far, as of heights on a map.
class IsoLines : public OverlayProps
{
public:
  explicit IsoLines(vtkRenderer& renderer);

  /// How far apart in displacement they are: 1, 2 or 5 times a power of ten, for 3 to 8 lines.
  /// @param depth  of the press [m]
  /// @return       [m]
  [[nodiscard]] static double stepOf(double depth) noexcept;

  void show(const OverlayState& state) override;
  void hide() override;

private:
  vtkNew<vtkPolyData> lines_;
  vtkNew<vtkActor> actor_;
};

} // namespace palp
