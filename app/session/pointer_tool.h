#pragma once

#include "haptics/devices/simulated/guided_tool.h"
#include "haptics/servo/sample.h"
#include "haptics/surface/surface_point.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace palp
{

/// A line of sight through a pixel.
struct SightLine
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ(); ///< unit vector
};

/// The mouse pointer as a tool: what its events ask of the tool, without a screen.
///
/// The tool hovers where the pointer is. The left button presses there, at first visibly but
/// lightly; dragging down goes deeper. A click is shown for a moment after its button is up, and
/// the tool lifts before the next, so that each is a press of its own. The wheel holds a depth
/// while the pointer slides over the surface. A pointer that leaves the surface lets go of it, also
/// where no event tells of the gap between two places. No depth is beyond half of the body's
/// thickness below the place.
class PointerTool
{
public:
  static constexpr double kTouch = 1e-3;            ///< of a button that went down [m]
  static constexpr double kDepthPerPixel = 0.05e-3; ///< of a drag [m]
  static constexpr double kDepthPerNotch = 0.5e-3;  ///< of the wheel [m]
  static constexpr double kMaxDepth = 0.05;         ///< that is ever asked for [m]
  static constexpr double kShortest = 0.3;          ///< that a press is asked for [s]

  /// @param view  the line of sight through a pixel, as the camera is now
  explicit PointerTool(std::function<SightLine(double x, double y)> view);

  /// Another body, or the organs that are felt: the tool stays where it is until the pointer is
  /// over one of them.
  void setSurfaces(std::vector<std::shared_ptr<const Surface>> surfaces);

  // Events; x, y in pixels, time in seconds since any moment.

  void hover(int x, int y);
  /// @return  whether it is over the body
  bool press(int x, int y, double time);
  void drag(int pixelsDown);
  void release(double time);
  void wheel(int notches); ///< nothing where the pointer is known to be beside the body
  void deepen(double by);  ///< what the wheel holds [m]

  /// Presses once at a place, whatever the pointer does meanwhile: apart from what was pressed
  /// before, down, kShortest of rest, and up. A button, the wheel or letGo() ends it.
  /// @param point  on the surface
  /// @param depth  [m]
  /// @param speed  [m/s], more than 0
  void pressAt(const SurfacePoint& point, double depth, double speed);

  /// Leads such a press on, by what the tool did. Whoever is late stretches its rest: a call counts
  /// for 50 ms at most.
  void lead(const Sample& newest);

  /// Whether such a press goes on.
  [[nodiscard]] bool pressesByItself() const noexcept
  {
    return given_.has_value();
  }

  /// The view turned below the pointer: nothing is known of the way to its next place.
  void turnView();

  /// Ends each press: Escape, another window, a pointer that is no longer in the view.
  void letGo();

  /// Ends a click that was shown long enough, and begins one that waits for a lift.
  void update(double time);

  /// Nothing until the pointer has been over the body.
  [[nodiscard]] std::optional<PressTarget> target() const;

private:
  // a press that goes by itself
  struct Given
  {
    enum class Phase
    {
      Lift,
      Press,
      Rise,
    };

    double depth; // [m]
    double speed; // [m/s]
    Phase phase = Phase::Lift;
    double deepest = 0.0;         // that the tool was [m]
    double waited = 0.0;          // since something came of it [s]
    std::optional<double> last{}; // time that it was led to [s]
  };

  struct Pixel
  {
    double x;
    double y;
  };

  [[nodiscard]] std::optional<SurfacePoint> below(const Pixel& pixel) const;
  [[nodiscard]] bool leftSurface(const Pixel& to) const;
  void moveTo(const SurfacePoint& point);
  void lift(double time);
  [[nodiscard]] const Surface& surfaceAt(const SurfacePoint& point) const;

  std::function<SightLine(double, double)> view_;
  std::vector<std::shared_ptr<const Surface>> surfaces_;
  std::optional<SurfacePoint> point_; // of the tool
  std::optional<Pixel> last_;         // of a pointer that moved with no button down
  double deepest_ = kMaxDepth;        // at the place [m]
  double held_ = 0.0;                 // by the wheel [m]
  double pressed_ = 0.0;              // by the button [m]
  double from_ = 0.0;                 // depth that the drag started from [m]
  bool pressing_ = false;             // the button is down
  double pressedAt_ = 0.0;            // [s]
  double apartAt_ = -1e9;             // when the tool is surely apart from the press before [s]
  bool isLifting_ = false;            // until then
  std::optional<Given> given_;
};

} // namespace palp
