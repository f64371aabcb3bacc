#include "haptics/servo/passivity.h"

#include <Eigen/Geometry>

namespace palp
{
namespace
{

// a coarse encoder makes what is taken seem less without end
constexpr double kLargestDebt = 1e-3; // [J]
// what damping has taken beyond need is no credit for long
constexpr double kLargestCredit = 1e-4; // [J]

} // namespace

// mean over the last tick: each acts for as long as its own tick, a delay after its pose
Wrench PassivityController::acting(double dt, double delay) const noexcept
{
  Wrench sum;
  double age = 0.0; // of the end of a force's own tick [s]
  for (std::size_t i = 0; i < kForces; ++i)
  {
    const std::size_t slot = (newest_ + kForces - i) % kForces;
    const double end = age - delay; // of its action, before now
    const double begin = end + lengths_[slot];
    const double overlap = std::min(begin, dt) - std::max(end, 0.0);
    if (overlap > 0.0)
    {
      sum.force += overlap / dt * wrenches_[slot].force;
      sum.torque += overlap / dt * wrenches_[slot].torque;
    }
    if (end >= dt)
    {
      break;
    }
    age += lengths_[slot];
  }
  return sum;
}

// Within the step of the encoder: an arm that has just come into a step is at most one tick's way
// past its border. Half a step there, as often as it goes back and forth under a stiff force, adds
// up.
Eigen::Vector3d PassivityController::within(const PortTick& tick) const noexcept
{
  const Eigen::Array3d read = tick.position;
  const Eigen::Array3d half = Eigen::Array3d::Constant(0.5 * quantum_);
  const Eigen::Array3d way = tick.dt * tick.velocity;
  const Eigen::Array3d jump = read - read_.array();
  const Eigen::Array3d come = read - jump.sign() * (half - 0.5 * way.abs()).max(0.0);
  const Eigen::Array3d stayed = (place_.array() + way).max(read - half).min(read + half);
  return (jump.abs() > half).select(come, stayed);
}

Eigen::Vector3d PassivityController::damp(const PortTick& tick) noexcept
{
  lengths_[newest_] = tick.dt;
  const Eigen::Vector3d travel = tick.position - read_;
  const Eigen::Vector3d place = within(tick);
  const Wrench acted = acting(tick.dt, tick.delay);
  const double turned = acted.torque.dot(axis_.cross(tick.axis));
  energy_ -= acted.force.dot(place - place_) + turned;
  // by what was read, as the springs answered it: where an arm chatters over a step, that is the
  // more cautious
  const double taken = -acted.force.dot(travel) - turned;
  const double lost =
    mechanism_.damping * travel.squaredNorm() / tick.dt + mechanism_.friction * travel.norm();
  balance_ =
    std::clamp(balance_ + taken + lost, tick.stored - kLargestDebt, tick.stored + kLargestCredit);
  place_ = place;
  read_ = tick.position;
  axis_ = tick.axis;
  newest_ = (newest_ + 1) % kForces;
  wrenches_[newest_] = {};
  lengths_[newest_] = 0.0;

  const double missing = tick.stored - balance_;
  if (missing <= 0.0 || tick.velocity.norm() <= atRest_)
  {
    return Eigen::Vector3d::Zero();
  }
  const double damping = missing / (tick.dt * tick.velocity.squaredNorm());
  return -std::min(tick.share * maxDamping_, damping) * tick.velocity;
}

void PassivityController::restart(const ToolPose& pose) noexcept
{
  energy_ = 0.0;
  balance_ = 0.0;
  wrenches_.fill({});
  lengths_.fill(0.0);
  place_ = pose.apex;
  read_ = pose.apex;
  axis_ = pose.axis;
}

} // namespace palp
