#pragma once

#include "haptics/pose.h"
#include "haptics/tip/tip.h"

#include <array>
#include <vtkActor.h>
#include <vtkCleanPolyData.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataSilhouette.h>

class vtkRenderer;

namespace palp
{

/// How the tool is drawn.
enum class ToolLook
{
  Solid,    ///< glass, which the dent is seen through
  Outlined, ///< nothing but its contour stands before the dent
  Hidden
};

/// The tool as glass, or its contour as the eye has it, with its sharp edges: light on dark, so
/// that it is seen before any ground.
class ToolProps
{
public:
  /// Not shown before it has a place; the contour follows the camera that the renderer has now.
  explicit ToolProps(vtkRenderer& renderer);

  /// @param tip  checked
  void setTip(const Tip& tip);

  /// That is drawn of such a tool, from its apex [m].
  [[nodiscard]] static double heightOf(const Tip& tip);

  void setLook(ToolLook look);

  /// @param pose  one that is not finite is not shown
  void place(const ToolPose& pose);

private:
  void show();

  ToolLook look_ = ToolLook::Solid;
  bool isKnown_ = false; // where it is
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> glass_;
  vtkNew<vtkCleanPolyData> joined_; // at creases, where the surface has its points twice
  vtkNew<vtkPolyDataSilhouette> edges_;
  std::array<vtkNew<vtkActor>, 2> lines_; // dark and wide, light and narrow
};

} // namespace palp
