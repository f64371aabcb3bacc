#pragma once

namespace palp
{

struct DevicesOptions;

/// Lists devices on standard output, probes one, or watches them come and go.
/// @return         exit code: 0 a device can be used, 3 none is there, 6 one is there but cannot be
/// @throws Error   NoDevice: the one to probe cannot be used, and why
[[nodiscard]] int showDevices(const DevicesOptions& options);

} // namespace palp
