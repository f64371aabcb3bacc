#pragma once

#include "haptics/devices/bytes.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

namespace palp
{

// PHD1, the open protocol for boards of one's own: README.md beside this file describes it.

inline constexpr std::size_t kPhd1Report = 64; ///< [bytes], both ways, without report id

/// From the board.
struct Phd1State
{
  bool homed = false;
  bool stopped = false; ///< its emergency stop is pressed
  bool motorsOn = false;
  std::uint16_t sequence = 0;
  std::uint32_t microseconds = 0;                          ///< of the board's clock; wraps
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< [m], steps of 1 um
  std::array<double, 4> orientation{ 1.0, 0.0, 0.0, 0.0 }; ///< w x y z, unit
  std::uint16_t buttons = 0;
  std::uint8_t temperature = 0; ///< of the motors [deg C]
};

enum class Phd1Order : std::uint8_t
{
  Idle,
  Force,
  Home,
  Stop,
};

/// To the board.
struct Phd1Command
{
  Phd1Order order = Phd1Order::Idle;
  std::uint16_t sequence = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(); ///< [N], steps of 1 mN, clamped to 32 N
  double damping = 0.0;                            ///< by the board itself [N s/m], to 65
};

/// @return    nothing: too short, another version, or a checksum that does not fit
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] std::optional<Phd1State> decodePhd1State(Bytes report) noexcept;
[[nodiscard]] std::optional<Phd1Command> decodePhd1Command(Bytes report) noexcept;

/// @return    a report of kPhd1Report bytes; a force that is not finite is zero
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] std::array<std::byte, kPhd1Report> encode(const Phd1State& state) noexcept;
[[nodiscard]] std::array<std::byte, kPhd1Report> encode(const Phd1Command& command) noexcept;

} // namespace palp
