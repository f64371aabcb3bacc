#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/hid/rate_motion.h"
#include "haptics/files/descriptor.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <linux/input.h>
#include <memory>
#include <string>
#include <vector>

namespace palp
{

/// A game pad that is plugged in and may be read.
struct FoundGamepad
{
  std::string name;
  std::string path;
  bool rumbles = false; ///< and may be told to
};

/// Game pads, by their paths. What may not be read cannot be told from a keyboard, and is left out.
/// @param folder  where the system shows input devices
[[nodiscard]] std::vector<FoundGamepad> listGamepads(
  const std::filesystem::path& folder = "/dev/input");

/// A game pad that drives the tool at a rate and rumbles as the force does: a cue, which no hand
/// feels as a force.
///
/// The left stick moves the tool right and away, the right one up and down, the cross tilts it. The
/// rumble ends by itself 0.2 s after the last tick, and with the program.
/// @source  Linux kernel, Documentation/input: gamepad.rst, event-codes.rst, ff.rst
class GamepadDriver final : public Driver
{
public:
  static constexpr double kFullForce = 4.0; ///< at which it rumbles most [N]

  /// @param node  of evdev, not blocking; open for writing, or it does not rumble
  explicit GamepadDriver(Descriptor node);
  ~GamepadDriver() override;
  GamepadDriver(const GamepadDriver&) = delete;
  GamepadDriver& operator=(const GamepadDriver&) = delete;

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept override;

private:
  static constexpr std::size_t kAxes = ABS_HAT0Y + 1;

  void synchronize() noexcept;
  void take(const input_event& event) noexcept;
  [[nodiscard]] double deflection(std::size_t axis) const noexcept;
  [[nodiscard]] SpaceMouseState state() const noexcept;
  void rumble(double force, double dt) noexcept;
  void play(bool on) noexcept;

  Descriptor node_;
  std::array<input_absinfo, kAxes> axes_{};
  std::uint32_t buttons_ = 0;
  RateMotion motion_;
  bool rumbles_;
  ff_effect effect_{};
  double sinceTold_ = 0.0; // [s]
};

/// @param path    empty: the first that is found
/// @throws Error  NoDevice: none, gone, no game pad, or not permitted; and what to do
[[nodiscard]] std::unique_ptr<Driver> openGamepad(const std::string& path);

} // namespace palp
