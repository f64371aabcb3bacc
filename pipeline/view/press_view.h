#pragma once

#include "calibration/tables/extent_table.h"
#include "haptics/servo/sample.h"
#include "pipeline/deform/press_of.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "pipeline/model/overlay.h"
#include "pipeline/model/surface_map.h"
#include "pipeline/view/appearance.h"
#include "pipeline/view/dent_colors.h"
#include "pipeline/view/overlay_props.h"
#include "pipeline/view/readings.h"
#include "pipeline/view/tool_props.h"
#include "pipeline/view/vtkPalpPatchMapper.h"

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>
#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>

namespace palp
{

/// How the body is drawn beside its colors.
struct BodyLook
{
  bool hasEdges = false;      ///< of its triangles
  bool isTranslucent = false; ///< what lies behind is seen
  bool isCut = false;         ///< open at the contact, without the half that is nearer to the eye
  ToolLook tool = ToolLook::Solid;
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

  /// @param surface   at rest [m], triangles only; shared, not copied
  /// @param isClosed  nobody sees its inside, which is not drawn then
  void setSurface(vtkPolyData* surface, bool isClosed = false);

  /// Whether it is the surface that is shown.
  [[nodiscard]] bool shows(vtkPolyData& surface) const
  {
    return rest_->GetPoints() == surface.GetPoints();
  }

  /// Of the surface; the bundled liver's at first.
  void setColor(const appearance::Color& color);

  /// What else is seen when the whole surface is looked at [m].
  void setAround(const vtkBoundingBox& box)
  {
    around_ = box;
  }

  /// @param tip  checked
  void setTip(const Tip& tip);

  /// R_d for every depth; without a table the ring ends close to the contact.
  void setExtents(const ExtentTable& extents)
  {
    extents_ = extents;
  }

  /// What the surface around the tool is drawn as; the paper's ring at first.
  void setStyle(DentStyle style)
  {
    style_ = std::move(style);
  }

  /// The law whose rules the validity colors and readings name.
  void setLaw(const ForceLaw& law)
  {
    dent_->setLaw(law);
  }

  /// Moves the tool, presses the surface, and sets the overlays. Does not render.
  void show(const Sample& sample);

  /// Takes effect at once; the cut stands across the view of this moment and follows the contact.
  void setLook(const BodyLook& look);
  [[nodiscard]] const BodyLook& look() const
  {
    return look_;
  }

  /// At first: arrow, circles, colors and lines of the displacement, readings. Takes effect in
  /// show().
  void setVisible(Overlay overlay, bool visible);
  [[nodiscard]] bool isVisible(Overlay overlay) const;

  /// Shows these overlays and no others.
  void setVisible(const std::vector<Overlay>& overlays);

  /// Upper end of the colors [mm or kPa]; 0, the default, lets it follow the press.
  void setColorRange(double top)
  {
    dent_->setRange(top);
  }

  /// Shows the whole surface by these colors, and the dent by no others; null: by its own again.
  /// Takes effect in show().
  /// @param map  of as many values as the surface has points
  void setMap(const SurfaceMap* map);

  /// Whether colors have their bar beside them; at first they do. Takes effect in show().
  void setColorBar(bool shown)
  {
    dent_->setLegend(shown);
  }

  /// The whole surface, from the front and above.
  void lookAtSurface();

  /// The whole surface from a side, as from -y, its front where it stands in LPS.
  ///
  /// @param eye  direction from the surface to the eye
  /// @param up   of the picture; not along the other
  void lookFrom(const Eigen::Vector3d& eye, const Eigen::Vector3d& up);

  /// The whole surface with a place on it, head up where it is pressed from a side.
  ///
  /// @param position   on the surface [m]
  /// @param normal  unit, outward
  void lookAtWhole(const Eigen::Vector3d& position, const Eigen::Vector3d& normal);

  /// R_d of the table for a depth [m]; 0 without a table.
  [[nodiscard]] double extentRadius(double depth) const noexcept;

  /// The press that is drawn of a sample, by the tool, R_d and style in use.
  /// @param beside  of another tool, which moves the body with it
  [[nodiscard]] Press drawnPress(const Sample& sample, const std::vector<OrganLoad>& beside) const;

  /// What the tool of a sample moves the body with, as it would be shown.
  [[nodiscard]] std::vector<OrganLoad> loadsOf(const Sample& sample) const;

  [[nodiscard]] const Tip& tip() const noexcept
  {
    return tip_;
  }

  /// Another number after setTip() and setColor().
  [[nodiscard]] int version() const noexcept
  {
    return version_;
  }
  [[nodiscard]] vtkProperty& surfaceProperty()
  {
    return *surface_->GetProperty();
  }
  [[nodiscard]] const appearance::Color& color() const noexcept
  {
    return color_;
  }

  /// Opens what a mapper draws as the surface is open, or not.
  void cut(vtkMapper& mapper);

  /// Whether dents are drawn by themselves, left out of the surface.
  [[nodiscard]] bool drawsDentsApart() const
  {
    return surfaceMapper_->GetHideDent();
  }

  /// Of another dent with the same colors [m]; takes effect in show().
  void setDeepestBeside(double depth) noexcept
  {
    deepestBeside_ = depth;
  }

  /// What another hand moves the body with, too; takes effect in show().
  void setBeside(std::vector<OrganLoad> loads) noexcept
  {
    beside_ = std::move(loads);
  }

  /// What their colors mean.
  [[nodiscard]] DentColors::By colors() const;

  /// The surface as last shown [m], with the arrays of vtkPalpDeformFilter.
  [[nodiscard]] vtkPolyData* deformed();

  /// The filter that presses the surface, for what else is made of it.
  [[nodiscard]] vtkPalpDeformFilter& press()
  {
    return *deform_;
  }

private:
  [[nodiscard]] vtkBoundingBox whole();
  void addSurface();
  void addOverlays();
  void placeCut(const Contact& contact);
  void colorSurface();
  void placeDent(const OverlayState& state);

  vtkRenderer& renderer_;
  Tip tip_{ SphereTip{ .radius = 0.01 } };
  std::optional<ExtentTable> extents_;
  DentStyle style_;
  Sample left_{};                 // the last that touched, whose dent may still come back
  double deepestBeside_ = 0.0;    // [m]
  std::vector<OrganLoad> beside_; // of another hand
  int version_ = 0;
  appearance::Color color_ = appearance::kLiver;
  double diagonal_ = 0.0; // of the surface's box [m]
  double above_ = 0.0;    // the surface reach tool and arrow [m]

  vtkBoundingBox around_;

  BodyLook look_;
  bool isClosed_ = false;
  vtkNew<vtkPlane> cut_;
  vtkNew<vtkActor> cap_;                                // what a closed body is filled with there
  Eigen::Vector3d cutAlong_ = Eigen::Vector3d::UnitY(); // as one looked when it was asked for

  std::optional<SurfaceMap> map_; // none: the surface has its own color

  vtkNew<vtkPolyData> rest_; // the surface, with the values of its map
  vtkNew<vtkPalpDeformFilter> deform_;
  vtkNew<vtkPalpPatchMapper> surfaceMapper_;
  vtkNew<vtkActor> surface_;
  std::optional<ToolProps> tool_; // translucent, so after the others
  std::optional<DentColors> dent_;
  std::array<bool, kOverlayCount> visible_{};
  std::array<std::unique_ptr<OverlayProps>, kOverlayCount> overlays_; // null: part of dent_
  Readings* readings_ = nullptr;                                      // one of overlays_
};

} // namespace palp
