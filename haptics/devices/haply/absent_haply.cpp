// Stands in for haply_driver.cpp where libwebsockets is absent.

#include "haptics/devices/haply/haply_driver.h"

#include "haptics/error.h"

namespace palp
{

std::unique_ptr<Driver> openHaply(const std::string&)
{
  findHaply();
  return {};
}

void findHaply()
{
  throw Error(ErrorCode::NoDevice,
    "Haply Inverse3: this build has no libwebsockets; install libwebsockets-dev and build again");
}

} // namespace palp
