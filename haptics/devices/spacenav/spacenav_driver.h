#pragma once

#include "haptics/devices/driver.h"

#include <memory>

namespace palp
{

/// Any six-axis mouse that spacenavd knows, also serial and old ones; renders no force.
/// @throws Error  NoDevice: spacenavd does not run, or this build has no libspnav
[[nodiscard]] std::unique_ptr<Driver> openSpacenav();

} // namespace palp
