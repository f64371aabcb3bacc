#include "haptics/stability/arm_loop.h"

#include "haptics/devices/velocity_estimator.h"
#include "haptics/servo/safety.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kFine = 50e-6;      // step of the integration, at most [s]
constexpr double kWaiting = 0.3;     // before the hand moves [s]
constexpr double kMaxForce = 7.9;    // of the motors [N]
constexpr double kReach = 40.0_mm;   // of the workspace
constexpr double kSphere = 100.0_mm; // radius of the curved tissue
constexpr double kAside = 20.0_mm;   // of its top, where it is touched
constexpr double kGuide = 300.0;     // of a hand, across its push [N/m]
constexpr double kThrough = 30.0_mm; // no hand pushes deeper
constexpr double kHolds = 5.0;       // by how much more than it pushes it holds back
constexpr double kYield = 20.0_mm;   // in which its force falls to nothing
constexpr double kGap = 5.0_mm;      // before contact
constexpr double kDrawn = 30.0_mm;   // along a scene
constexpr double kPressing = 1.0;    // before that [s]

// where the tool is, in words of contact
struct Geometry
{
  ArmWorld world;

  [[nodiscard]] Vector3d normal(const Vector3d& apex) const
  {
    switch (world)
    {
      case ArmWorld::Sphere:
        return (apex - center()).normalized();
      case ArmWorld::Workspace:
        return -apex.normalized();
      case ArmWorld::Plane:
      case ArmWorld::Scene:
        break;
    }
    return Vector3d::UnitZ();
  }

  [[nodiscard]] double depth(const Vector3d& apex) const
  {
    switch (world)
    {
      case ArmWorld::Sphere:
        return kSphere - (apex - center()).norm();
      case ArmWorld::Workspace:
        return apex.norm() - kReach;
      case ArmWorld::Plane:
      case ArmWorld::Scene:
        break;
    }
    return -apex.z();
  }

  [[nodiscard]] Vector3d start() const
  {
    switch (world)
    {
      case ArmWorld::Sphere:
        return { kAside, 0.0, std::sqrt(kSphere * kSphere - kAside * kAside) - kSphere + kGap };
      case ArmWorld::Workspace:
        return { 0.0, 0.0, -(kReach - kGap) };
      case ArmWorld::Plane:
        break;
      case ArmWorld::Scene:
        return { -0.5 * kDrawn, 0.0, kGap };
    }
    return { 0.0, 0.0, kGap };
  }

private:
  static Vector3d center()
  {
    return { 0.0, 0.0, -kSphere };
  }
};

// what stands between encoders and motors
class Between
{
public:
  Between(const ArmCase& arm, bool chain)
    : arm_(arm)
    , geometry_{ arm.world }
    , velocity_(arm.quantum)
  {
    scene_.forceLimit = 4.0;
    if (chain)
    {
      chain_.emplace(limits(), SafetySettings{ .period = arm.period });
    }
  }

  Vector3d operator()(const Vector3d& apex)
  {
    const Vector3d seen = arm_.quantum > 0.0
      ? Vector3d((apex / arm_.quantum).array().round().matrix() * arm_.quantum)
      : apex;
    const ToolPose pose{ .apex = seen, .velocity = velocity_(seen, arm_.period) };
    if (arm_.scene != nullptr)
    {
      return inScene(pose);
    }
    const auto ask = [this](double at) noexcept { return arm_.law(at); };
    if (!chain_)
    {
      const double depth = geometry_.depth(seen);
      const double push =
        arm_.world == ArmWorld::Workspace ? 300.0 * std::max(0.0, depth) : ask(depth).force;
      return std::min(push, kMaxForce) * geometry_.normal(seen);
    }
    Sample sample;
    sample.pose = *chain_->admit(pose, {}, { .armed = true }, arm_.period);
    const double depth = geometry_.depth(sample.pose.apex);
    if (depth > 0.0 && arm_.world != ArmWorld::Workspace)
    {
      sample.contact =
        Contact{ .depth = depth, .normal = geometry_.normal(sample.pose.apex), .triangle = 0 };
    }
    chain_->limit(sample, ask, scene_);
    flags_ |= sample.flags;
    return sample.force;
  }

  [[nodiscard]] const SafetyChain* chain() const
  {
    return chain_ ? &*chain_ : nullptr;
  }

  [[nodiscard]] std::uint32_t flags() const
  {
    return flags_;
  }

private:
  Vector3d inScene(const ToolPose& pose)
  {
    const Sample sample = chain_
      ? step(*arm_.scene, memory_, *chain_, pose, {}, { .armed = true }, arm_.period)
      : step(*arm_.scene, memory_, pose, arm_.period);
    flags_ |= sample.flags;
    return sample.force;
  }

  [[nodiscard]] DeviceLimits limits() const
  {
    return { .model = "simulated arm",
      .rendersForce = true,
      .maxForce = kMaxForce,
      .damping = arm_.damping,
      .friction = arm_.friction,
      .mass = arm_.mass,
      .handDamping = arm_.statedHand,
      .quantum = arm_.quantum,
      .delay = arm_.statedDelay,
      .velocityDelay = arm_.quantum > 0.0 ? VelocityEstimator::kLongestDelay : 0.0,
      .workspaceRadius = arm_.world == ArmWorld::Workspace ? kReach : 0.0,
      .scale = arm_.scale };
  }

  const ArmCase& arm_;
  Geometry geometry_;
  VelocityEstimator velocity_;
  Scene scene_;
  TissueMemory memory_;
  std::optional<SafetyChain> chain_;
  std::uint32_t flags_ = 0;
};

// mass, damper and Coulomb friction under a force; implicit in what brakes
struct Arm
{
  Vector3d apex;
  Vector3d velocity;
  double port = 0.0; // energy taken from the hand by the motors [J]
  double lost = 0.0; // in the mechanism [J]

  void advance(const ArmCase& arm, const Vector3d& target, const Vector3d& push,
    const Vector3d& force, double time)
  {
    const Vector3d away = target - apex;
    const Vector3d aside(away.x(), away.y(), 0.0); // where a constant force pushes, too
    const Vector3d hand =
      push + (arm.handStiffness > 0.0 ? arm.handStiffness * away : kGuide * aside);
    const double braking = 1.0 + (arm.damping + arm.handDamping) * time / arm.mass;
    velocity = (velocity + (hand + force) * time / arm.mass) / braking;
    const double stops = arm.friction * time / arm.mass / braking;
    const double speed = velocity.norm();
    velocity *= speed > stops ? 1.0 - stops / speed : 0.0;
    const Vector3d travel = velocity * time;
    apex += travel;
    port -= force.dot(travel);
    lost += arm.damping * velocity.dot(travel) + arm.friction * travel.norm();
  }
};

struct OnTheWay
{
  double acts; // [s]
  Vector3d force;
};

void seeSpeed(ArmResult& result, double fraction, double speed)
{
  const auto within = [fraction](double from, double to)
  { return fraction > from && fraction <= to; };
  double unused = 0.0;
  double& most = within(0.125, 0.25) ? result.earlySpeed
    : within(0.625, 0.75)            ? result.middleSpeed
    : within(0.875, 2.0)             ? result.lateSpeed
                                     : unused;
  most = std::max(most, speed);
}

// the same forces over a motion that is scaled
ArmCase atTool(ArmCase arm)
{
  for (double* dynamic :
    { &arm.mass, &arm.damping, &arm.statedHand, &arm.handStiffness, &arm.handDamping })
  {
    *dynamic /= arm.scale;
  }
  for (double* motion : { &arm.quantum, &arm.handDepth, &arm.startSpeed })
  {
    *motion *= arm.scale;
  }
  return arm;
}

} // namespace

ArmResult simulateArm(const ArmCase& hand, bool chain)
{
  const ArmCase arm = atTool(hand);
  const Geometry geometry{ arm.world };
  Between controller(arm, chain);
  Arm state{ .apex = geometry.start(), .velocity = Vector3d::Zero() };
  for (double time = 0.0; time < kWaiting; time += arm.period)
  {
    (void)controller(state.apex);
  }
  const Vector3d inward = -Vector3d::UnitZ();
  state.velocity = arm.startSpeed * inward;
  const bool hasSpring = arm.handStiffness > 0.0;
  const Vector3d from = state.apex;
  const Vector3d push = hasSpring ? Vector3d(Vector3d::Zero()) : Vector3d(arm.handForce * inward);
  const int fine = static_cast<int>(std::ceil(arm.period / kFine));
  const double step = arm.period / fine;

  ArmResult result;
  std::deque<OnTheWay> onTheWay;
  Vector3d force = Vector3d::Zero();
  double time = 0.0;
  while (time < arm.duration)
  {
    onTheWay.push_back({ time + arm.delay, controller(state.apex) });
    if (controller.chain() != nullptr)
    {
      result.worstObserved =
        std::max(result.worstObserved, std::abs(controller.chain()->energy() - state.port));
    }
    for (int i = 0; i < fine; ++i, time += step)
    {
      const double drawn =
        std::clamp(arm.drawnSpeed * (time - kPressing), 0.0, arm.scene != nullptr ? kDrawn : 0.0);
      const Vector3d target = from + drawn * Vector3d::UnitX() +
        std::min(kGap + arm.handDepth, arm.startSpeed * time) * inward;
      const double yields =
        std::clamp((kThrough - geometry.depth(state.apex)) / kYield, -kHolds, 1.0);
      double done = 0.0; // of this step [s], for a force acts from its very moment on
      for (; !onTheWay.empty() && onTheWay.front().acts < time + step; onTheWay.pop_front())
      {
        const double until = std::clamp(onTheWay.front().acts - time, done, step);
        state.advance(arm, target, yields * push, force, until - done);
        done = until;
        force = onTheWay.front().force;
      }
      state.advance(arm, target, yields * push, force, step - done);
      result.energy = std::min(result.energy, state.port + state.lost);
      result.peakForce = std::max(result.peakForce, force.norm());
      seeSpeed(result, time / arm.duration, state.velocity.norm());
    }
  }
  result.portEnd = state.port;
  result.endDepth = geometry.depth(state.apex);
  result.flags = controller.flags();
  if (controller.chain() != nullptr)
  {
    result.observedEnd = controller.chain()->energy();
    result.ended = controller.chain()->state() == DeviceState::Ready;
  }
  return result;
}

} // namespace palp
