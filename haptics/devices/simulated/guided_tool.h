#pragma once

#include "haptics/contact/contact.h"
#include "haptics/servo/organ_touch.h"
#include "haptics/threads/latest.h"

#include <cstdint>
#include <optional>

namespace palp
{

/// Where on a surface a tool is to press, and how deep.
struct PressTarget
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< on the surface [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward unit vector; the tool points back
  double depth = 0.0; ///< of the contact, at most [m]; 0: hover above the place
  double speed = 0.0; ///< at which the depth of a contact changes [m/s]; 0: as fast as it may

  bool operator==(const PressTarget&) const = default;
};

/// A tool without mass that is led over a surface and is never deeper than it was told.
///
/// Targets come in jumps, some of them across the body. In the air the tool appears above the new
/// place and comes down along its normal. In contact it slides along the surface at the depth of
/// the target; where that way is blocked, too long or leads around the body, it lifts and presses
/// anew. Each pose is tried with touchOrgan before it is taken, so that none is deeper than the
/// target, or than half the body's thickness below the contact, and none lies on its side against
/// the surface, as over the edge of a thin lobe; a tool that is too deep because its target was
/// lifted withdraws first. It stays away from a place where it does not fit. Where the target has a
/// speed, the depth is a straight line over time, however late a tick is.
///
/// The main thread steers; one other thread advances.
class GuidedTool
{
public:
  static constexpr double kSpeed = 0.25;    ///< along and into the surface [m/s], a quick stroke
  static constexpr double kLagTime = 0.020; ///< to close most of a short gap [s]
  static constexpr double kHover = 0.003;   ///< of the apex above a place that is not pressed [m]

  /// @param start    where the tool rests until its first target, in the air
  /// @throws Error   BadValue: not finite
  explicit GuidedTool(const ToolPose& start);

  /// Main thread only. A target that is not finite is ignored.
  void moveTo(const PressTarget& target);

  /// What is in the way; main thread only. Without a surface the tool is at its target at once.
  void setScene(const Scene& scene);

  /// One tick.
  ///
  /// @param dt         since the last one [s]; nothing moves unless it is above 0
  /// @param mayAppear  a tool in the air may be elsewhere at once; if not, it waits where it is
  /// @realtime         no allocation, no lock, no exception
  [[nodiscard]] const ToolPose& advance(double dt, bool mayAppear = true) noexcept;

  /// What advance() found in the way. Of the thread that advances.
  [[nodiscard]] const Scene& scene() noexcept
  {
    return scene_.read();
  }

private:
  static constexpr double kNear = 0.003;    // from its place, the tool is there [m]
  static constexpr double kHighest = 0.015; // above a place, to come down from [m]

  struct Trial // a pose, and what the tool touches there, after the pose that it has
  {
    ToolPose pose;
    Contact contact;
    OrganTouch touch{};
  };

  [[nodiscard]] Trial at(const Eigen::Vector3d& apex, const Eigen::Vector3d& axis) const noexcept;
  [[nodiscard]] double deepest(const Trial& trial) const noexcept;
  [[nodiscard]] bool mayStay(const Trial& trial) const noexcept;
  [[nodiscard]] Trial settled(Trial trial, double depth, double reach) const noexcept;
  [[nodiscard]] Eigen::Vector3d gap() const noexcept;
  [[nodiscard]] double depthAfter(double dt) const noexcept;
  void watch(double dt) noexcept;
  [[nodiscard]] bool isAbove() const noexcept;
  [[nodiscard]] bool mustLift() const noexcept;
  void take(const PressTarget& target) noexcept;
  void move(double dt, bool mayAppear) noexcept;
  bool appear() noexcept;
  void rise(double reach) noexcept;
  void withdraw(double reach) noexcept;
  void descend(double dt) noexcept;
  void slide(double dt) noexcept;

  Latest<std::optional<PressTarget>> target_;
  Latest<Scene> scene_;

  // of the thread that advances
  const Scene* world_ = nullptr; // as read in this tick
  std::optional<std::uint64_t> version_;
  std::optional<PressTarget> asked_;
  std::optional<PressTarget> goal_; // that which was asked for, as deep as it is by now
  Trial now_;
  ToolPose start_;
  std::optional<Eigen::Vector3d> approached_; // the place that the tool came down to last [m]
  double closest_ = 0.0;                      // to its target so far [m]
  double stalled_ = 0.0;                      // how long it comes no closer [s]
  bool lifting_ = false;                      // until it is in the air
  bool resting_ = false;                      // until there is another target or scene
};

} // namespace palp
