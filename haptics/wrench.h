#pragma once

#include <Eigen/Core>

namespace palp
{

/// What a tool does to the hand that holds it: a force at its apex, and a torque about that.
struct Wrench
{
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero(); ///< [N m]

  Wrench() = default;

  /// A force alone, as most arms render it.
  template <typename Force>
  Wrench(const Eigen::MatrixBase<Force>& only) noexcept
    : force(only)
  {
  }

  Wrench(const Eigen::Vector3d& push, const Eigen::Vector3d& twist) noexcept
    : force(push)
    , torque(twist)
  {
  }

  [[nodiscard]] bool isZero() const noexcept
  {
    return force.isZero(0.0) && torque.isZero(0.0);
  }

  [[nodiscard]] friend Wrench operator*(double part, const Wrench& whole) noexcept
  {
    return { part * whole.force, part * whole.torque };
  }

  [[nodiscard]] friend Wrench operator*(const Eigen::Matrix3d& turn, const Wrench& whole) noexcept
  {
    return { turn * whole.force, turn * whole.torque };
  }
};

} // namespace palp
