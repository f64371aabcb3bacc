#pragma once

#include "haptics/servo/scene.h"

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace palp
{

/// Which organ of a scene a tool touches, from tick to tick.
struct OrganTouch
{
  int organ = 0;                         ///< that is touched, or was last
  bool touching = false;                 ///< the tool, in the last tick
  double depth = 0.0;                    ///< that was felt then [m]
  double withheld = 0.0;                 ///< depth that is not felt yet, since a handover [m]
  std::optional<Eigen::Vector3d> apex{}; ///< then [m]; none: nothing is known of its motion
  std::uint64_t version = 0;             ///< of the scene

  // which of the first 64 organs the tool may come to, as far as it stays near a place
  std::uint64_t near = 0;
  std::optional<Eigen::Vector3d> nearTo{}; ///< center of the tool's Reach [m]; none: not yet known

  /// Nothing is touched yet where the scene is another.
  /// @realtime  no allocation, no lock, no exception
  void follow(const Scene& scene) noexcept
  {
    *this = version == scene.version ? *this : OrganTouch{ .version = scene.version };
  }
};

/// Contact with one organ: that which the tool met first, until it is lifted from it.
///
/// Of several that were entered within a tick, the one first met is that which the tool has been in
/// for the largest part of its way; without a motion into them, the deepest. An organ that the tool
/// cannot reach is not looked at, but for its box at each 5 cm of motion in the air.
///
/// A tool that is lifted from one inside of another feels that from the depth that it felt before,
/// and the rest as it moves, by as much as it moves: so the force changes by no more than twice the
/// motion and the stiffness allow, and a tool that rests feels no force grow.
///
/// @param before  the last tick; becomes this one
/// @realtime      no allocation, no lock, no exception
[[nodiscard]] Contact touchOrgan(
  const Scene& scene, const ToolPose& pose, OrganTouch& before) noexcept;

} // namespace palp
