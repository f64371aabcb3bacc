#pragma once

#include "haptics/devices/zero_packet.h"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace palp
{

/// What the service of Haply says of an Inverse3 and of the grip at its end.
struct HaplyState
{
  std::array<char, 64> id{};                                       ///< of the arm, ends with 0
  Eigen::Vector3d position = Eigen::Vector3d::Zero();              ///< x right, y away, z up [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity(); ///< of the grip, unit
  std::uint32_t buttons = 0;                                       ///< of the grip
  bool hasGrip = false;                                            ///< and has told how it is held
  bool calibrated = false;                                         ///< and powered
  bool centered = false; ///< its positions are from the middle of the workspace
  double reach = 0.1;    ///< from there to every side [m]
  bool oldWords = false; ///< the service is older than 3.5 and calls a force otherwise
};

/// Takes up one message; what it does not name stays as it was.
/// @param state  once it has an id, of this arm; before, of the first in the message
/// @return       false: not a message of the service, or without this arm; the state is unchanged
/// @source       docs.haply.co/inverseSDK, WebSocket Protocol and Simulation Channel, 3.5 and 3.1;
///               presets and reach: Mount and Workspace, tutorial 05
[[nodiscard]] bool takeHaplyMessage(std::string_view text, HaplyState& state);

/// A force for one tick, after which the arm is idle again.
/// @param force  [N], finite
/// @param first  with the name of this program, for the service's list, and the wish for positions
///               from the middle of the workspace
[[nodiscard]] std::string haplyCommand(
  const HaplyState& arm, const Eigen::Vector3d& force, bool first);

/// The command of no force as the text frame of a WebSocket's client, for a guardian.
/// @source  RFC 6455, 5.2; the key of its mask is 0, so that the text stands as it is
[[nodiscard]] ZeroPacket haplyZero(const HaplyState& arm);

} // namespace palp
