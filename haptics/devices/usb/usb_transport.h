#pragma once

#include "haptics/devices/transport.h"

#include <memory>

namespace palp
{

/// Opens the first Novint Falcon. The only place that knows libusb, with usb_transport.cpp.
/// @throws Error  NoDevice: absent, busy, or not permitted, and what to do
[[nodiscard]] std::unique_ptr<SerialTransport> openFalcon();

} // namespace palp
