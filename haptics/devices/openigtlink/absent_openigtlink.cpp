// Stands in for openigtlink_driver.cpp where libopenigtlink is absent.

#include "haptics/devices/openigtlink/openigtlink_driver.h"

#include "haptics/error.h"

namespace palp
{

std::unique_ptr<Driver> openOpenIgtLink(const std::string&)
{
  throw Error(ErrorCode::NoDevice,
    "OpenIGTLink: this build has no libopenigtlink; install libopenigtlink-dev and build again");
}

} // namespace palp
