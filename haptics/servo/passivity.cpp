#include "haptics/servo/passivity.h"

namespace palp
{
namespace
{

// a coarse encoder makes the observed energy too pessimistic without end
constexpr double kLargestDebt = 1e-3; // [J]

} // namespace

Eigen::Vector3d PassivityController::damp(
  const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double dt) noexcept
{
  energy_ = std::max(energy_ - sent_.dot(position - position_), -kLargestDebt);
  position_ = position;
  if (energy_ >= 0.0 || velocity.norm() <= atRest_)
  {
    return Eigen::Vector3d::Zero();
  }
  return -std::min(maxDamping_, -energy_ / (dt * velocity.squaredNorm())) * velocity;
}

void PassivityController::restart(const Eigen::Vector3d& position) noexcept
{
  energy_ = 0.0;
  sent_.setZero();
  position_ = position;
}

} // namespace palp
