// Stands in for usb_transport.cpp where libusb is absent.

#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/usb_transport.h"
#include "haptics/error.h"

namespace palp
{

const char* usbUnusableReason() noexcept
{
  return "this build has no libusb; install libusb-1.0-0-dev and build again";
}

std::vector<FoundDevice> listUsb()
{
  return {};
}

std::unique_ptr<SerialTransport> openFalcon()
{
  throw Error(ErrorCode::NoDevice, std::string("Novint Falcon: ") + usbUnusableReason());
}

} // namespace palp
