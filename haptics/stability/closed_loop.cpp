#include "haptics/stability/closed_loop.h"

#include "haptics/devices/velocity_estimator.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>

namespace palp
{
namespace
{

using Eigen::Vector3d;

constexpr double kSettling = 0.2; // before the hand moves [s]

// exact motion of m x'' + b x' = u over a time, u constant
struct Motion
{
  double depth;
  double speed;

  void advance(const Plant& plant, double push, double time)
  {
    const double rate = plant.damping / plant.mass;
    const double glide = -std::expm1(-rate * time) / rate; // path of a unit speed
    depth += glide * speed + (time - glide) / plant.damping * push;
    speed += -rate * glide * speed + glide / plant.mass * push;
  }
};

// the surface is the plane z = 0, pressed straight down
ToolPose poseAt(double depth, const Vector3d& velocity)
{
  return { .apex = Vector3d(0.0, 0.0, -depth), .velocity = velocity };
}

Contact contactAt(double depth)
{
  return depth > 0.0 ? Contact{ .depth = depth, .normal = Vector3d::UnitZ(), .triangle = 0 }
                     : Contact{};
}

// what stands between pose and motors
class Controller
{
public:
  explicit Controller(const LoopCase& loop)
    : loop_(loop)
    , velocity_(loop.plant.quantum)
  {
    scene_.damping = loop.damping;
    scene_.forceLimit = loop.forceLimit;
    if (loop.chain)
    {
      SafetySettings settings = *loop.chain;
      settings.period = loop.period;
      chain_.emplace(
        DeviceLimits{ .model = "simulation",
          .rendersForce = true,
          .maxForce = loop.plant.maxForce,
          .damping = loop.plant.statedDamping.value_or(loop.plant.damping),
          .quantum = loop.plant.quantum,
          .delay = loop.plant.delay * loop.period,
          .velocityDelay = loop.plant.quantum > 0.0 ? VelocityEstimator::kLongestDelay : 0.0 },
        settings);
    }
  }

  // push of the tissue on the tool, outward [N]
  double operator()(double depth, double dt, bool swapped)
  {
    const double step = loop_.plant.quantum;
    const double seen = step > 0.0 ? std::floor(depth / step) * step : depth;
    const ToolPose pose = poseAt(seen, velocity_(Vector3d(0.0, 0.0, -seen), dt));
    const auto& law = swapped ? loop_.swapped : loop_.law;
    const double rise = swapped ? loop_.swapRise : 0.0;
    scene_.version = swapped ? 1 : 0;
    if (!chain_)
    {
      const double push =
        seen + rise > 0.0 ? law(seen + rise).force - loop_.damping * pose.velocity.z() : 0.0;
      return std::clamp(push, 0.0, loop_.plant.maxForce);
    }
    const auto admitted = chain_->admit(pose, {}, { .armed = true }, dt);
    Sample sample;
    sample.pose = *admitted;
    sample.contact = contactAt(rise - admitted->apex.z());
    const auto ask = [&](double at) noexcept { return law(at); };
    chain_->limit(sample, ask, scene_);
    flags_ |= sample.flags;
    return sample.force.z();
  }

  [[nodiscard]] std::uint32_t flags() const
  {
    return flags_;
  }

  [[nodiscard]] bool ended() const
  {
    return chain_ && chain_->state() == DeviceState::Ready; // though it is armed
  }

  [[nodiscard]] double observedEnergy() const
  {
    return chain_ ? chain_->energy() : 0.0;
  }

private:
  const LoopCase& loop_;
  VelocityEstimator velocity_;
  Scene scene_;
  std::optional<SafetyChain> chain_;
  std::uint32_t flags_ = 0;
};

// lengths of the ticks, jittered and dropped always in the same way
class Clock
{
public:
  explicit Clock(const LoopCase& loop)
    : loop_(loop)
    , drop_(loop.dropEvery)
  {
  }

  double next(double now)
  {
    double dt = loop_.period;
    if (loop_.jitter > 0.0)
    {
      dt *= 1.0 + loop_.jitter * spread_(random_);
    }
    if (loop_.dropped > 0 && now >= drop_)
    {
      drop_ += loop_.dropEvery;
      dt += loop_.dropped * loop_.period;
    }
    return dt;
  }

private:
  const LoopCase& loop_;
  std::minstd_rand random_;
  std::uniform_real_distribution<double> spread_{ -1.0, 1.0 };
  double drop_;
};

// the hand rests, so that a force may start
void settle(Controller& controller, const LoopCase& loop)
{
  for (double time = 0.0; time < kSettling; time += loop.period)
  {
    (void)controller(loop.plant.startDepth, loop.period, false);
  }
}

// speed early on, and where the loop still hums at the end
void seeSpeed(LoopResult& result, double fraction, double speed, double force)
{
  if (fraction > 0.125 && fraction <= 0.25)
  {
    result.earlySpeed = std::max(result.earlySpeed, speed);
  }
  if (fraction > 0.875 && force > 0.0)
  {
    result.limitCycleSpeed = std::max(result.limitCycleSpeed, speed);
  }
}

} // namespace

LoopResult simulate(const LoopCase& loop)
{
  const Plant& plant = loop.plant;
  Controller controller(loop);
  settle(controller, loop);

  LoopResult result;
  Clock clock(loop);
  Motion motion{ plant.startDepth, plant.startSpeed };
  std::deque<double> onTheWay(static_cast<std::size_t>(plant.delay), 0.0);
  double port = 0.0;
  double dissipated = 0.0;
  double tail = 0.0;
  double tailTime = 0.0;
  double dt = loop.period;
  double last = 0.0;
  for (double time = 0.0; time < loop.duration; time += dt)
  {
    onTheWay.push_back(
      controller(motion.depth, dt, loop.swapped != nullptr && time >= loop.swapAt));
    const double force = onTheWay.front();
    onTheWay.pop_front();
    dt = clock.next(time);

    const Motion before = motion;
    motion.advance(plant, plant.handForce - force, dt);
    const double travel = motion.depth - before.depth;
    port += force * travel;
    dissipated += (plant.handForce - force) * travel -
      0.5 * plant.mass * (motion.speed * motion.speed - before.speed * before.speed);

    const double speed = std::abs(motion.speed);
    result.energy = std::min(result.energy, port + dissipated);
    result.portEnergy = std::min(result.portEnergy, port);
    result.peakForce = std::max(result.peakForce, force);
    result.peakStep = std::max(result.peakStep, std::abs(force - last));
    last = force;
    const double fraction = time / loop.duration;
    seeSpeed(result, fraction, speed, force);
    if (fraction > 0.75)
    {
      tail += speed * speed * dt;
      tailTime += dt;
    }
  }
  result.portEnd = port;
  result.tailSpeed = tailTime > 0.0 ? std::sqrt(tail / tailTime) : 0.0;
  result.observedEnergyEnd = controller.observedEnergy();
  result.ended = controller.ended();
  result.flags = controller.flags();
  result.endDepth = motion.depth;
  result.endForce = last;
  return result;
}

} // namespace palp
