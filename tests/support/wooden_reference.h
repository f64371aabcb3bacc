#pragma once

// A WoodenHaptics arm of 2015 in the words of its makers, sharing nothing with the driver: numbers
// from forsslund/haptikfabrikenapi src/haptikfabrikenapi.h (woodenhaptics_v2015), geometry from its
// src/kinematics.cpp, and forces by virtual work from that geometry alone.

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

namespace palp::test
{

using WoodenCounts = std::array<int, 3>;   // of the motors a, b, c; more turn a body further
using WoodenCurrents = std::array<int, 3>; // in them [mA]

inline constexpr WoodenCounts kWoodenRest{ 0, 0, 6000 }; // calibrate_enc_a, b, c

inline constexpr std::array kWoodenGear{ 16.0, 12.0, 12.0 }; // diameters of body by capstan
inline constexpr double kWoodenCounts = 2000.0;              // in a turn of a motor
inline constexpr double kWoodenTorque = 0.0259;              // of a motor [N m/A]

inline Eigen::Vector3d woodenAngles(const WoodenCounts& counts) // of the bodies [rad]
{
  Eigen::Vector3d angles;
  for (std::size_t i = 0; i < 3; ++i)
  {
    angles[static_cast<int>(i)] =
      2.0 * std::numbers::pi * counts[i] / kWoodenCounts / kWoodenGear[i];
  }
  return angles;
}

inline Eigen::Vector3d woodenTool(const Eigen::Vector3d& angles) // [m]
{
  const double reach = 0.205 * std::sin(angles[1]) + 0.245 * std::sin(angles[2]);
  return { std::cos(angles[0]) * reach - 0.220, std::sin(angles[0]) * reach,
    0.080 + 0.205 * std::cos(angles[1]) - 0.245 * std::cos(angles[2]) - 0.080 };
}

inline Eigen::Vector3d woodenTool(const WoodenCounts& counts)
{
  return woodenTool(woodenAngles(counts));
}

// what a hand that holds the tool feels [N]: no virtual turn of a body does work
inline Eigen::Vector3d woodenForce(const WoodenCounts& counts, const WoodenCurrents& currents)
{
  constexpr double kStep = 1e-5; // [rad]
  const Eigen::Vector3d angles = woodenAngles(counts);
  Eigen::Matrix3d ways; // of the tool, by the angles
  Eigen::Vector3d torques;
  for (int i = 0; i < 3; ++i)
  {
    const auto motor = static_cast<std::size_t>(i);
    const Eigen::Vector3d turn = kStep * Eigen::Vector3d::Unit(i);
    ways.col(i) = (woodenTool(angles + turn) - woodenTool(angles - turn)) / (2.0 * kStep);
    torques[i] = 1e-3 * currents[motor] * kWoodenTorque * kWoodenGear[motor];
  }
  return ways.transpose().inverse() * torques;
}

// by which a force in whole milliamperes may differ from any force [N]
inline double woodenRounding(const WoodenCounts& counts)
{
  return 0.5 *
    (woodenForce(counts, { 1, 0, 0 }).norm() + woodenForce(counts, { 0, 1, 0 }).norm() +
      woodenForce(counts, { 0, 0, 1 }).norm());
}

} // namespace palp::test
