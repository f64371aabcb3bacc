// A WoodenHaptics of three bodies whose axes are coupled: inertia of its rotors and of its handle,
// friction in its joints, counts of its encoders, of which one may die or count ten times as much.
#pragma once

#include "haptics/devices/hid/wooden_haptics.h"
#include "haptics/devices/identify/identify.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>

namespace palp::test
{

struct CoupledArm
{
  WoodenArm shape;
  double handle = 0.1;                               // [kg]
  Eigen::Vector3d rotors{ 4e-3, 5e-3, 3e-3 };        // at the bodies [kg m^2]
  Eigen::Vector3d damping{ 0.012, 0.012, 0.012 };    // [N m s/rad]
  Eigen::Vector3d friction{ 2e-3, 2e-3, 2e-3 };      // [N m]
  Eigen::Vector3d counted = Eigen::Vector3d::Ones(); // counts told of one that is
  double delay = 0.002;                              // [s]
  int dead = -1;                                     // the encoder that dies
  double dies = 0.0;                                 // [s]
  double strongest = 0.0;                            // [N]
  double furthest = 0.0;                             // of the handle [m]
  double unseen = 0.0;                               // of the handle since the encoder died [m]
  double time = 0.0;
  Eigen::Vector3d told = Eigen::Vector3d::Zero(); // last [N]

  explicit CoupledArm(const WoodenArm& arm = {})
    : shape(arm)
  {
    // where the handle is at the origin of its workspace
    for (int i = 0; i < 50; ++i)
    {
      angles_ -= positionJacobian(shape, angles_).inverse() * forwardKinematics(shape, angles_);
    }
    begin_ = angles_;
    heard_ = angles_;
  }

  // J^-T M J^-1, of the handle at the place where it is [kg]
  [[nodiscard]] Eigen::Matrix3d mass() const
  {
    const Eigen::Matrix3d inverse = positionJacobian(shape, angles_).inverse();
    return inverse.transpose() * inertia(angles_) * inverse;
  }

  // likewise [N s/m]
  [[nodiscard]] Eigen::Matrix3d dampingOfHandle() const
  {
    const Eigen::Matrix3d inverse = positionJacobian(shape, angles_).inverse();
    return inverse.transpose() * damping.asDiagonal() * inverse;
  }

  // moves on under the last torque
  void wait(double duration)
  {
    constexpr double kStep = 50e-6; // [s]
    for (long steps = std::lround(duration / kStep); steps > 0; --steps)
    {
      step(kStep);
    }
  }

  ArmPosition exchange(const Eigen::Vector3d& force)
  {
    told = force;
    strongest = std::max(strongest, force.norm());
    const double sent = time;
    const Eigen::Vector3d torques = positionJacobian(shape, heard_).transpose() * force;
    commands_.emplace_back(sent + delay, torques);
    wait(1e-3);
    const Eigen::Vector3d place = forwardKinematics(shape, angles_);
    furthest = std::max(furthest, place.norm());
    const double count = 2.0 * std::numbers::pi * shape.capstan[0] / shape.body[0] / 2000.0;
    for (int joint = 0; joint < 3; ++joint)
    {
      const double turned = counted[joint] * (angles_[joint] - begin_[joint]);
      if (joint != dead || time < dies)
      {
        heard_[joint] = begin_[joint] + count * std::round(turned / count);
      }
    }
    if (dead >= 0 && time >= dies)
    {
      died_ = died_.value_or(place);
      unseen = std::max(unseen, (place - *died_).norm());
    }
    return { .position = forwardKinematics(shape, heard_),
      .time = time,
      .sent = sent,
      .joints = DriverJoints{ heard_, torques } };
  }

  IdentifiedArm identify()
  {
    return identifyArm([this](const Eigen::Vector3d& force) { return exchange(force); }, 54e-6);
  }

private:
  [[nodiscard]] Eigen::Matrix3d inertia(const Eigen::Vector3d& at) const
  {
    const Eigen::Matrix3d jacobian = positionJacobian(shape, at);
    return Eigen::Matrix3d(rotors.asDiagonal()) + handle * jacobian.transpose() * jacobian;
  }

  // friction as a stiff viscous one near rest
  void step(double dt)
  {
    constexpr double kSlow = 2e-3; // [rad/s]
    while (!commands_.empty() && commands_.front().first <= time + 1e-9)
    {
      torque_ = commands_.front().second;
      commands_.pop_front();
    }
    const Eigen::Vector3d stuck =
      friction.array() / (velocity_.array().abs() + kSlow); // implicit, so that it never overshoots
    const Eigen::Vector3d viscous = damping + stuck;
    const Eigen::Matrix3d mass = inertia(angles_);
    const Eigen::Matrix3d left = mass + dt * Eigen::Matrix3d(viscous.asDiagonal());
    velocity_ = left.inverse() * (mass * velocity_ + dt * torque_);
    angles_ += dt * velocity_;
    time += dt;
  }

  std::deque<std::pair<double, Eigen::Vector3d>> commands_;
  Eigen::Vector3d angles_{ 0.0, 0.35, 0.66 };
  Eigen::Vector3d begin_ = angles_;
  Eigen::Vector3d heard_ = angles_;
  Eigen::Vector3d torque_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> died_;
};

} // namespace palp::test
