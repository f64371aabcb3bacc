#pragma once

#include "haptics/contact/pose.h"

#include <Eigen/Core>
#include <optional>
#include <string>

namespace palp
{

/// What a device can do and bear.
struct DeviceLimits
{
  std::string model;            ///< for people
  bool rendersForce = false;    ///< a hand can feel it
  double maxForce = 0.0;        ///< [N]
  double maxStiffness = 0.0;    ///< stable closed-loop stiffness at 1 kHz [N/m]
  double workspaceRadius = 0.0; ///< [m]
};

/// One thing that holds the tool: a hand, an arm, a recorded path.
///
/// Set up and closed on the main thread; exchange() is called by one thread only.
class Device
{
public:
  virtual ~Device() = default;

  [[nodiscard]] virtual DeviceLimits limits() const = 0;

  /// One tick: takes the force, gives the pose at its end.
  ///
  /// @param force  on the hand [N], finite; zero when off
  /// @param dt     since the last tick [s]
  /// @return       nothing when the device is gone
  /// @realtime     no allocation, no lock, no exception; must not block
  [[nodiscard]] virtual std::optional<ToolPose> exchange(
    const Eigen::Vector3d& force, double dt) noexcept = 0;
};

} // namespace palp
