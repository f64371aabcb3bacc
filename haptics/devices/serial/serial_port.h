#pragma once

#include "haptics/devices/transport.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace palp
{

/// A port of USB, on which a board may be.
struct SerialPort
{
  std::string path;
  bool permitted = false; ///< to read and write it
};

inline constexpr const char* kSerialPermission =
  "no permission; join the group dialout, then log in again";

/// Ports that are plugged in, by their paths; none is opened, as that may reset a board.
/// @param folder  where the system shows them
[[nodiscard]] std::vector<SerialPort> serialPorts(const std::filesystem::path& folder = "/dev");

/// Whether a path is a serial port, whose opening may reset a board.
[[nodiscard]] bool isSerialPort(const std::string& path);

/// Opens a serial port for raw bytes, for one palp at a time. A port of USB has no baud rate; on
/// others it is 115,200.
/// @throws Error  NoDevice: gone, busy, or not permitted, and what to do
[[nodiscard]] std::unique_ptr<Transport> openSerialPort(const std::string& path);

} // namespace palp
