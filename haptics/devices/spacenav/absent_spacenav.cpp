// Stands in for spacenav_driver.cpp where libspnav is absent.

#include "haptics/devices/spacenav/spacenav_driver.h"

#include "haptics/error.h"

namespace palp
{

std::unique_ptr<Driver> openSpacenav()
{
  throw Error(ErrorCode::NoDevice,
    "spacenavd: this build has no libspnav; install libspnav-dev and build again");
}

} // namespace palp
