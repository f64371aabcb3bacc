#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/guard/guard.h"

#include <functional>
#include <memory>

namespace palp
{

/// A transport whose every call is a sign of life to a guardian, which shares its descriptor.
class GuardedTransport final : public SerialTransport
{
public:
  /// @param serial  the same transport where it has requests of its own, or null
  GuardedTransport(
    std::unique_ptr<Transport> transport, SerialTransport* serial, std::shared_ptr<Guard> guard);

  [[nodiscard]] IoResult read(
    MutableBytes into, std::chrono::microseconds timeout) noexcept override;
  [[nodiscard]] IoCode write(Bytes bytes) noexcept override;
  [[nodiscard]] bool request(std::uint8_t what, std::uint16_t value) noexcept override;
  [[nodiscard]] int descriptor() const noexcept override
  {
    return transport_->descriptor();
  }

private:
  std::unique_ptr<Transport> transport_;
  SerialTransport* serial_; // the same, or null
  std::shared_ptr<Guard> guard_;
};

/// What the program does once its guardian has ended a force.
///
/// After a silence of less than 50 ms the force returns from zero in 0.1 s. After a longer one,
/// before and after a suspend, or with the guardian dead, the device tells an emergency stop: it
/// has to be armed anew.
class GuardedDriver final : public Driver
{
public:
  GuardedDriver(std::unique_ptr<Driver> driver, std::shared_ptr<Guard> guard);

  [[nodiscard]] DeviceLimits limits() const override
  {
    return driver_->limits();
  }
  [[nodiscard]] IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept override;

private:
  [[nodiscard]] double gain(double dt) noexcept;

  std::unique_ptr<Driver> driver_;
  std::shared_ptr<Guard> guard_;
  std::uint32_t fired_ = 0; // as of the last tick
  std::int64_t last_;       // [ns]
  std::int64_t asleep_;     // [ns]
  double gain_ = 1.0;       // of the force
  double stoppedFor_ = 0.0; // what is left of telling a stop [s]
};

/// Gives a device with motors a guardian.
/// @param zero    ends its force
/// @param make    its driver, of the transport that it is given
/// @throws Error  as Guard, and what make throws
[[nodiscard]] std::unique_ptr<Driver> guarded(std::unique_ptr<Transport> transport,
  const ZeroPacket& zero,
  const std::function<std::unique_ptr<Driver>(std::unique_ptr<Transport>)>& make);

/// The same of a device behind a USB chip.
[[nodiscard]] std::unique_ptr<Driver> guardedUsb(std::unique_ptr<SerialTransport> transport,
  const ZeroPacket& zero,
  const std::function<std::unique_ptr<Driver>(std::unique_ptr<SerialTransport>)>& make);

} // namespace palp
