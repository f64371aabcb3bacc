// Stands in for hid_transport.cpp where hidapi is absent.

#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/hid_transport.h"
#include "haptics/error.h"

namespace palp
{

const char* hidUnusableReason() noexcept
{
  return "this build has no hidapi; install libhidapi-dev and build again";
}

std::vector<FoundDevice> listHid()
{
  return {};
}

std::unique_ptr<Transport> openHid(const std::string& path)
{
  throw Error(ErrorCode::NoDevice, path + ": " + hidUnusableReason());
}

} // namespace palp
