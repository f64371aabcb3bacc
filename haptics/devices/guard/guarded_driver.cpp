#include "haptics/devices/guard/guarded_driver.h"

#include <algorithm>
#include <utility>

namespace palp
{
namespace
{

constexpr std::int64_t kLate = 50'000'000; // a silence that is still a late tick [ns]
constexpr double kReturn = 0.1;            // from zero to full force after one [s]
constexpr double kTell = 0.1;     // a stop, so that the servo sees it however late it is [s]
constexpr double kLongest = 0.01; // a tick, also that which was stopped itself [s]

} // namespace

GuardedTransport::GuardedTransport(
  std::unique_ptr<Transport> transport, SerialTransport* serial, std::shared_ptr<Guard> guard)
  : transport_(std::move(transport))
  , serial_(serial)
  , guard_(std::move(guard))
{
}

IoResult GuardedTransport::read(MutableBytes into, std::chrono::microseconds timeout) noexcept
{
  guard_->beat();
  const IoResult result = transport_->read(into, timeout);
  guard_->beat();
  return result;
}

IoCode GuardedTransport::write(Bytes bytes) noexcept
{
  const bool forced = asksForForce(bytes, guard_->zero());
  guard_->beat();
  if (forced)
  {
    guard_->setForced(true);
  }
  const IoCode code = transport_->write(bytes);
  if (!forced && code == IoCode::Ok)
  {
    guard_->setForced(false);
  }
  return code;
}

bool GuardedTransport::request(std::uint8_t what, std::uint16_t value) noexcept
{
  guard_->beat();
  return serial_ != nullptr && serial_->request(what, value);
}

GuardedDriver::GuardedDriver(std::unique_ptr<Driver> driver, std::shared_ptr<Guard> guard)
  : driver_(std::move(driver))
  , guard_(std::move(guard))
  , fired_(guard_->fired())
  , last_(nanoseconds(CLOCK_MONOTONIC))
  , asleep_(suspendedFor())
{
}

double GuardedDriver::gain(double dt) noexcept
{
  const std::int64_t now = nanoseconds(CLOCK_MONOTONIC);
  const std::int64_t silence = now - std::exchange(last_, now);
  const std::int64_t slept = suspendedFor();
  const bool suspended = slept - std::exchange(asleep_, slept) > kSuspended;
  const std::uint32_t fired = guard_->fired();
  const bool ended = fired != std::exchange(fired_, fired);
  const double passed = std::min(dt, kLongest);
  stoppedFor_ = std::max(0.0, stoppedFor_ - passed);
  if (suspended || guard_->leaving() || !guard_->lives() || (ended && silence > kLate))
  {
    stoppedFor_ = kTell;
  }
  gain_ = ended || stoppedFor_ > 0.0 ? 0.0 : std::min(1.0, gain_ + passed / kReturn);
  return gain_;
}

IoCode GuardedDriver::tick(const Wrench& wrench, double dt, DriverSample& sample) noexcept
{
  const double share = gain(dt);
  const IoCode code = driver_->tick(share > 0.0 ? share * wrench : Wrench{}, dt, sample);
  sample.stopped = sample.stopped || (code == IoCode::Ok && stoppedFor_ > 0.0);
  return code;
}

std::unique_ptr<Driver> guarded(std::unique_ptr<Transport> transport, const ZeroPacket& zero,
  const std::function<std::unique_ptr<Driver>(std::unique_ptr<Transport>)>& make)
{
  auto guard = std::make_shared<Guard>(transport->descriptor(), GuardWire::File, zero);
  return std::make_unique<GuardedDriver>(
    make(std::make_unique<GuardedTransport>(std::move(transport), nullptr, guard)), guard);
}

std::unique_ptr<Driver> guardedUsb(std::unique_ptr<SerialTransport> transport,
  const ZeroPacket& zero,
  const std::function<std::unique_ptr<Driver>(std::unique_ptr<SerialTransport>)>& make)
{
  auto guard = std::make_shared<Guard>(transport->descriptor(), GuardWire::Usb, zero);
  SerialTransport* serial = transport.get();
  return std::make_unique<GuardedDriver>(
    make(std::make_unique<GuardedTransport>(std::move(transport), serial, guard)), guard);
}

} // namespace palp
