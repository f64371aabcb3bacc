#pragma once

#include "haptics/devices/transport.h"

#include <memory>
#include <string>

namespace palp
{

/// Whether a path is a serial port, whose opening may reset a board.
[[nodiscard]] bool isSerialPort(const std::string& path);

/// Opens a serial port for raw bytes, for one palp at a time. A port of USB has no baud rate; on
/// others it is 115,200.
/// @throws Error  NoDevice: gone, busy, or not permitted, and what to do
[[nodiscard]] std::unique_ptr<Transport> openSerialPort(const std::string& path);

} // namespace palp
