#pragma once

#include <string>
#include <vector>

namespace palp
{

/// What kind of device something is.
enum class DeviceKind
{
  SpaceMouse,
  Falcon,
  RawHid, ///< a generic board: its ids do not say what runs on it, so it is used only when named
  Gamepad,
  Serial, ///< a port of USB, of which likewise nothing says what speaks behind it
};

/// Something that is plugged in.
struct FoundDevice
{
  DeviceKind kind = DeviceKind::RawHid;
  std::string name;             ///< for people
  std::string ids{};            ///< vendor:product; empty where it has none
  std::string path;             ///< how to open it
  std::string unusableReason{}; ///< why it cannot be used, and what to do; empty when it can
};

/// Why no such device can be found whatever is plugged in, and what to do; empty where it can.
[[nodiscard]] const char* hidUnusableReason() noexcept;
[[nodiscard]] const char* usbUnusableReason() noexcept;

/// HID devices that are known, one for each interface that may talk.
[[nodiscard]] std::vector<FoundDevice> listHid();

/// USB devices that are known.
[[nodiscard]] std::vector<FoundDevice> listUsb();

/// All of both, the game pads and the serial ports.
[[nodiscard]] std::vector<FoundDevice> findDevices();

/// Names by which openDriver takes a device; a generic board may be one or the other.
[[nodiscard]] std::vector<std::string> namesOf(const FoundDevice& device);

} // namespace palp
