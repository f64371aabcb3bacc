// How stiff and how damped an arm may be rendered, how it turns a hand, and the end of its reach.
// The tick is in safety.cpp.

#include "haptics/servo/safety.h"
#include "haptics/servo/torque.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palp
{
namespace
{

constexpr double kMaxDamping = 2.0;      // of the law, by that of the device [-]
constexpr double kSmoothStep = 0.05;     // of the force, by one of the encoder [N]
constexpr double kWallStiffness = 300.0; // of the end of the workspace [N/m]
constexpr double kWallDamping = 2.0;     // [N s/m]
constexpr double kWallForce = 2.0;       // [N]

// a step of the encoder is then no jerk, or friction holds it (Diolaiti et al. 2006) [N/m]
double smoothStiffness(const DeviceLimits& device)
{
  return std::max(kSmoothStep, 2.0 * device.friction) / device.quantum;
}

} // namespace

// in simulated loops, from three times that of the device on, damping that comes a tick late makes
// a hand hum
double SafetyChain::renderedDamping(double wanted) const noexcept
{
  return std::min(wanted, kMaxDamping * device_.damping);
}

double SafetyChain::delay() const noexcept
{
  return measured_ ? delays_.period() : device_.delay;
}

double SafetyChain::stiffnessLimit(double damping) const noexcept
{
  // a damping that comes late helps little: count it with its delay, or not at all
  LoopDynamics loop{
    .deviceDamping = device_.damping, .period = period_.period(), .delay = delay()
  };
  const double bare = stableStiffness(loop);
  loop.deviceDamping += device_.handDamping;
  loop.friction = device_.friction;
  loop.scale = device_.scale;
  loop.quantum = device_.quantum;
  // no more by hand and friction than passivity control can replace, when the hand lets go or is
  // faster than friction counts for
  const double held = passivity_.maxDamping() / (loop.period / 2.0 + loop.delay);
  const double without = std::min(stableStiffness(loop), bare + held);
  loop.virtualDamping = renderedDamping(damping);
  loop.delay += device_.velocityDelay;
  const double stable = std::max(without, stableStiffness(loop));
  return std::min({ settings_.stiffnessFraction * stable, smoothStiffness(device_),
    guard_.stiffest(passivity_.maxDamping()) });
}

// Of the force, at which a lean of the tool is no stiffer than its wrist bears: were the torque
// alone less, its force would give energy as the tool leans. [N/m]
double SafetyChain::torqueStiffnessLimit(const Scene& scene) const noexcept
{
  const double reach = baseRadius(scene.law.tip());
  return device_.maxTorque > 0.0 ? device_.maxAngularStiffness / (reach * reach)
                                 : std::numeric_limits<double>::infinity();
}

// as much of the tissue's torque as is sent of its force
Eigen::Vector3d SafetyChain::renderedTorque(
  const Sample& sample, const Scene& scene, const TissueAt& tissue) const noexcept
{
  const double whole = sample.contact.slope * tissue(sample.proxyDepth).force;
  const double sent = sample.force.dot(sample.contact.normal);
  if (!(sent > 0.0 && whole > 0.0))
  {
    return Eigen::Vector3d::Zero();
  }
  const Eigen::Vector3d torque = std::min(1.0, sent / whole) * torqueAt(scene, sample, tissue);
  const double size = torque.norm();
  return size <= device_.maxTorque ? torque
    : std::isfinite(size)          ? Eigen::Vector3d(device_.maxTorque / size * torque)
                                   : Eigen::Vector3d::Zero();
}

// A hand that no torque answers leans the tool for nothing: by what the tool becomes deeper so, no
// force rises, and what was lost as it became less deep does not come back. What it pushes along
// is felt as ever.
void SafetyChain::followLean(const Sample& sample, const Scene& scene) noexcept
{
  const double depth = sample.contact.depth;
  const ToolPose before{ .apex = last_.apex, .axis = std::exchange(axis_, last_.axis) };
  if (!(depth > 0.0))
  {
    lean_ = 0.0;
    return;
  }
  if (device_.maxTorque > 0.0 || scene.surface == nullptr || before.axis == axis_)
  {
    return;
  }
  const double by = depth - findContact(scene, before).depth;
  const double held = std::min(lean_, contactOffset_);
  lean_ = std::max(0.0, held + by);
  contactOffset_ = std::min(contactOffset_ + lean_ - held, depth);
}

Eigen::Vector3d SafetyChain::workspaceForce(const ToolPose& pose) noexcept
{
  const Eigen::Vector3d reach = pose.apex - center_;
  const double distance = reach.norm();
  if (!(device_.workspaceRadius > 0.0) || distance <= device_.workspaceRadius)
  {
    return Eigen::Vector3d::Zero();
  }
  raise(Flag::Workspace);
  const Eigen::Vector3d outward = reach / distance;
  const double viscous = kWallDamping / device_.scale; // the wall is the arm's, and so of the hand
  const double stiffness =
    guard_.stiffnessShare() * std::min(kWallStiffness / device_.scale, stiffnessLimit(viscous));
  const double depth = distance - device_.workspaceRadius;
  const double reach0 = std::min(depth, kWallForce / stiffness);
  stored_ += stiffness * reach0 * (depth - 0.5 * reach0);
  const double damping = std::max(renderedDamping(viscous), guard_.damping(stiffness));
  const double push = stiffness * depth + damping * pose.velocity.dot(outward);
  return -std::clamp(push, 0.0, kWallForce) * outward;
}

} // namespace palp
