#pragma once

#include "haptics/devices/bytes.h"

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace palp
{

/// Geometry and motors of an arm of the WoodenHaptics family.
///
/// The defaults are WoodenHaptics of 2015; a text of `key = value` lines changes them.
/// @source  forsslund/haptikfabrikenapi, src/haptikfabrikenapi.h, woodenhaptics_v2015
struct WoodenArm
{
  std::array<double, 3> capstan{ 0.010, 0.010, 0.010 };   ///< diameters [m]
  std::array<double, 3> length{ 0.080, 0.205, 0.245 };    ///< of bodies a b c [m]
  std::array<double, 3> body{ 0.160, 0.120, 0.120 };      ///< diameters [m]
  std::array<double, 3> origin{ 0.220, 0.0, 0.080 };      ///< of the workspace [m]
  std::array<double, 3> torque{ 0.0259, 0.0259, 0.0259 }; ///< constants [N m/A]
  std::array<double, 3> counts{ 2000.0, 2000.0, 2000.0 }; ///< in a turn of the motor
  std::array<double, 3> sign{ 1.0, 1.0, 1.0 };            ///< of body against motor
  std::array<double, 3> rest{ 0.0, 0.0, 6000.0 };         ///< counts where it is calibrated
  std::array<double, 3> wrist{ 0.0, 0.0, 0.0 };           ///< counts in a turn; one of 0: no wrist
  std::array<double, 3> wristSign{ -1.0, -1.0, -1.0 };    ///< of its axes against their encoders
  double radius = 0.100;                                  ///< of the workspace [m]
  double maxForce = 5.0;                                  ///< [N]
  double maxCurrent = 2.0;                                ///< in a motor, for peakTime [A]
  double continuousCurrent = 1.0;                         ///< in a motor, for ever [A]
  double peakTime = 4.0; ///< that a cold motor and its amplifier bear maxCurrent [s]
  double damping = 0.5;  ///< b of the mechanism [N s/m]; measure it
};

/// Published arms: v2015, v2019, polhem (v1), aluhaptics (v2).
/// @return  nothing: no such name
/// @source  forsslund/haptikfabrikenapi, src/haptikfabrikenapi.h, configurations of these names
[[nodiscard]] std::optional<WoodenArm> publishedArm(std::string_view name) noexcept;

/// Arm from a text: `length = 0.080 0.205 0.245`, one key in a line, # for remarks, SI.
/// @throws Error  BadFile: name, line, what is wrong
[[nodiscard]] WoodenArm parseWoodenArm(std::string_view text, const std::string& name);

/// What the board says in a report of 14 bytes or more.
struct WoodenReport
{
  std::array<std::int16_t, 6> encoders{}; ///< [counts]
  bool calibrate = false;                 ///< the user has pressed the button of the board
  bool button = false;                    ///< of the handle, which the board adds to encoder d
};

/// @return    nothing: too short
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] std::optional<WoodenReport> decodeWooden(Bytes report) noexcept;

/// Currents to the motors [A], in steps of 1 mA.
/// @param report  of 14 bytes or more, as the board takes them, without report id
/// @realtime      pure; no allocation, no lock, no exception
void encodeWooden(const std::array<double, 3>& currents, MutableBytes report) noexcept;

/// Tells the board what its encoders read now: an arm that is held at rest.
/// @param report  of 14 bytes or more, as the board takes them, without report id
void encodeWoodenCalibration(const WoodenArm& arm, MutableBytes report) noexcept;

/// Angles of the three bodies [rad].
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Eigen::Vector3d jointAngles(
  const WoodenArm& arm, const std::array<std::int16_t, 6>& encoders) noexcept;

/// Position of the handle in the frame of its workspace [m].
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Eigen::Vector3d forwardKinematics(
  const WoodenArm& arm, const Eigen::Vector3d& angles) noexcept;

/// Orientation of the handle in the frame of its workspace, as DriverSample has it: a pen along the
/// last axis of the wrist, whose tip is at the arm. Without a wrist it stays upright.
/// @source    forsslund/haptikfabrikenapi, src/kinematics.cpp, computeRotation
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Eigen::Quaterniond wristOrientation(const WoodenArm& arm,
  const Eigen::Vector3d& angles, const std::array<std::int16_t, 6>& encoders) noexcept;

/// Derivative of the place by the angles of the bodies [m/rad].
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Eigen::Matrix3d positionJacobian(
  const WoodenArm& arm, const Eigen::Vector3d& angles) noexcept;

/// What three motors are given.
struct MotorCurrents
{
  std::array<double, 3> currents{};                  ///< [A], finite
  double share = 0.0;                                ///< of the force that was asked for, 0 to 1
  Eigen::Vector3d torques = Eigen::Vector3d::Zero(); ///< about the joints, of all of it [N m]
};

/// Currents that push the hand with a force, all shortened alike where one exceeds its largest.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] MotorCurrents motorCurrents(
  const WoodenArm& arm, const Eigen::Vector3d& angles, const Eigen::Vector3d& force) noexcept;

} // namespace palp
