#pragma once

#include "app/check/panel/fault_marks.h"
#include "haptics/surface/surface.h"
#include "haptics/surface/surface_point.h"

#include <Eigen/Geometry>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace palp
{

class CheckPanel;
struct CheckedSurface;
struct Finding;

/// What is wrong with the surface that is open, in a panel and marked in the picture. Main thread
/// only.
class SurfaceCheck
{
public:
  /// @param panel    outlives this object, as the renderer does
  /// @param changed  the picture is another
  SurfaceCheck(vtkRenderer& renderer, CheckPanel& panel, std::function<void()> changed);

  /// @param felt   that surface, in the picture
  /// @param frame  from its file to the picture
  void open(std::shared_ptr<const CheckedSurface> checked, std::shared_ptr<const Surface> felt,
    const Eigen::Isometry3d& frame);

  /// Forgets what was found.
  void close();

  /// Shows the marks, or not; what was found stays.
  void setVisible(bool shown);

  /// What was found last; null: nothing was checked.
  [[nodiscard]] std::shared_ptr<const CheckedSurface> checked() const
  {
    return checked_;
  }

  /// Where the fault is that is chosen, else the first that is marked, and which way is out; none:
  /// there is none.
  [[nodiscard]] std::optional<SurfacePoint> place() const;

  /// From corner to corner of a box around the surface [m].
  [[nodiscard]] double diagonal() const;

private:
  void draw();
  [[nodiscard]] std::vector<const Finding*> marked() const;
  [[nodiscard]] Eigen::Vector3d outwardAt(const Eigen::Vector3d& place) const;

  CheckPanel& panel_;
  std::function<void()> changed_;
  FaultMarks marks_;
  std::shared_ptr<const CheckedSurface> checked_{};
  std::shared_ptr<const Surface> felt_{};
  Eigen::Isometry3d frame_ = Eigen::Isometry3d::Identity();
  bool isShown_ = false;
};

} // namespace palp
