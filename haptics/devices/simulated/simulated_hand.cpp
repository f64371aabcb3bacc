#include "haptics/devices/simulated/simulated_hand.h"

#include "haptics/devices/turn.h"
#include "haptics/error.h"

#include <cmath>

namespace palp
{
namespace
{

// what an arm of a known desktop device bears, so that the chain limits a simulated hand alike
// @source  Phantom Desktop: 7.9 N, the device of the paper's Sec. 5
constexpr double kMaxForce = 7.9;   // [N]
constexpr double kTurnTime = 0.020; // for most of a turn of the wrist toward the target [s]

} // namespace

SimulatedHand::SimulatedHand(const ToolPose& start, const HandMechanics& mechanics)
  : mechanics_(mechanics)
  , tool_(start)
  , pose_{ .apex = start.apex, .axis = start.axis }
{
  const auto isZeroOrMore = [](double value) { return std::isfinite(value) && value >= 0.0; };
  if (!isZeroOrMore(mechanics.mass) || mechanics.mass == 0.0 || !isZeroOrMore(mechanics.damping) ||
    !isZeroOrMore(mechanics.stiffness))
  {
    throw Error(ErrorCode::BadValue,
      "simulated hand: mass, damping or stiffness out of range; give a mass above 0 kg, a damping "
      "and a stiffness of 0 or more");
  }
}

DeviceLimits SimulatedHand::limits() const
{
  return { .model = "simulated hand",
    .rendersForce = true,
    .maxForce = kMaxForce,
    .damping = mechanics_.damping };
}

std::optional<ToolPose> SimulatedHand::exchange(const Wrench& wrench, double dt) noexcept
{
  const Scene& scene = tool_.scene();
  OrganTouch none;
  const bool isFree = scene.surface == nullptr || !touchOrgan(scene, pose_, none).touching();
  const ToolPose& target = tool_.advance(std::isfinite(dt) ? dt : 0.0, isFree);
  if (dt > 0.0 && std::isfinite(dt) && wrench.force.allFinite())
  {
    // (m + c dt + k dt^2) v' = m v + dt (F + k (target - x)), then x' = x + dt v'
    const HandMechanics& hand = mechanics_;
    const Eigen::Vector3d push = wrench.force + hand.stiffness * (target.apex - pose_.apex);
    const double inertia = hand.mass + dt * (hand.damping + dt * hand.stiffness);
    pose_.velocity = (hand.mass * pose_.velocity + dt * push) / inertia;
    pose_.apex += dt * pose_.velocity;
    pose_.axis = turned(pose_.axis, target.axis, dt / (kTurnTime + dt));
  }
  return pose_;
}

} // namespace palp
