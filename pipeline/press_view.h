#pragma once

#include "calibration/extent_table.h"
#include "haptics/servo/sample.h"
#include "pipeline/vtkPalpDeformFilter.h"
#include "pipeline/vtkPalpPatchMapper.h"

#include <Eigen/Core>
#include <optional>
#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkContourFilter.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>

namespace palp
{

/// What is drawn over the surface; each can be hidden, and then costs nothing.
enum class Overlay
{
  ForceArrow,
  ContactCircle,
  ExtentCircle,
  DisplacementColors,
  Readings,
};

/// The pressed surface, the tool and the overlays in one renderer.
///
/// Both front ends, the picture and the window, show samples through it. Main thread only.
class PressView
{
public:
  /// Adds its props, lights and background to a renderer.
  explicit PressView(vtkRenderer& renderer);
  ~PressView();
  PressView(const PressView&) = delete;
  PressView& operator=(const PressView&) = delete;

  /// @param surface  at rest [m], triangles only; shared, not copied
  void setSurface(vtkPolyData* surface);

  /// @param tip  checked
  void setTip(const Tip& tip);

  /// R_d for every depth; without a table the ring ends close to the contact.
  void setExtents(const ExtentTable& extents);

  /// Moves the tool, presses the surface, and sets the overlays. Does not render.
  void show(const Sample& sample);

  void setVisible(Overlay overlay, bool visible);
  [[nodiscard]] bool isVisible(Overlay overlay) const;

  /// The whole surface, from the front and above.
  void lookAtSurface();

  /// One place and what surrounds it, obliquely, so that dent, tool and arrow are seen.
  ///
  /// @param place   on the surface [m]
  /// @param normal  unit, outward
  void lookAt(const Eigen::Vector3d& place, const Eigen::Vector3d& normal);

  /// R_d of the table for a depth [m]; 0 without a table.
  [[nodiscard]] double extentRadius(double depth) const noexcept;

  /// The surface as last shown [m], with the arrays of vtkPalpDeformFilter.
  [[nodiscard]] vtkPolyData* deformed();

private:
  struct Line
  {
    vtkNew<vtkContourFilter> contour;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> actor;
  };
  static constexpr std::size_t kOverlays = 5;

  void addSurface();
  void addTool();
  void addLine(Line& line, const std::array<double, 3>& color);
  void addTexts();
  void placeTool(const ToolPose& pose);
  void placeArrow(const Sample& sample);
  void placeCircles(const Sample& sample, double extent);
  void placeDent(const Sample& sample);
  void placeReadings(const Sample& sample, double extent);

  vtkRenderer& renderer_;
  std::array<bool, kOverlays> visible_{ true, true, true, true, true };
  Tip tip_{ SphereTip{ .radius = 0.01 } };
  std::optional<ExtentTable> extents_;
  double diagonal_ = 0.0; // of the surface's box [m]

  vtkNew<vtkPalpDeformFilter> deform_;
  vtkNew<vtkPalpPatchMapper> surfaceMapper_;
  vtkNew<vtkActor> surface_;
  vtkNew<vtkPolyDataMapper> dentMapper_;
  vtkNew<vtkActor> dent_; // the same finer or coloured
  vtkNew<vtkPolyDataMapper> toolMapper_;
  vtkNew<vtkActor> tool_;
  vtkNew<vtkArrowSource> arrowSource_;
  vtkNew<vtkPolyDataMapper> arrowMapper_;
  vtkNew<vtkActor> arrow_;
  vtkNew<vtkTextActor> forceLabel_;
  Line contactCircle_;
  Line extentCircle_;
  vtkSmartPointer<vtkLookupTable> colors_;
  vtkNew<vtkScalarBarActor> legend_;
  std::array<vtkNew<vtkTextActor>, 3> readings_;
};

} // namespace palp
