#pragma once

#include "haptics/devices/driver.h"

#include <memory>
#include <string>

namespace palp
{

/// A Haply Inverse3 or Minverse with its grip, through the service that its makers run beside it.
///
/// Its frame begins where its cursor is when it is first calibrated; as its grip is held then, or
/// when it wakes, it is upright. The service lets the arm go
/// idle once commands stop, and it is the service that would have to: a program that dies has no
/// hand on the arm's own wire.
/// @param port    of the service on this machine; empty: 10001
/// @throws Error  NoDevice: no service, no arm, or this build has no libwebsockets; BadValue: port
[[nodiscard]] std::unique_ptr<Driver> openHaply(const std::string& port);

/// Asks the service on its usual port for an arm, to which it sends nothing.
/// @throws Error  NoDevice: as openHaply()
void findHaply();

} // namespace palp
