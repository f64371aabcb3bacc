#pragma once

#include "haptics/devices/driver.h"

#include <memory>
#include <string>

namespace palp
{

/// An omega, delta, sigma or lambda of Force Dimension, by the library that came with it. Nothing
/// of that library is in this program.
/// @param library  libdrd of the makers' SDK 3; empty: libdrd.so.3 where the system looks for it
/// @throws Error   NoDevice: no such library, one that lacks a function, no arm; and what to do
[[nodiscard]] std::unique_ptr<Driver> openForceDimension(const std::string& library);

/// Looks for that library where the system does, and opens no arm: that may release its brakes.
/// @throws Error  NoDevice: no such library, one that lacks a function; and what to do
void requireForceDimension();

} // namespace palp
