#pragma once

#include "haptics/devices/transport.h"

#include <memory>
#include <string>

namespace palp
{

/// Opens a HID device, for one palp at a time. The only place that knows hidapi, with
/// hid_transport.cpp.
/// @throws Error  NoDevice: gone, busy, or not permitted, and what to do
[[nodiscard]] std::unique_ptr<Transport> openHid(const std::string& path);

} // namespace palp
