#include "haptics/devices/hid/hid_drivers.h"

#include "haptics/units.h"

#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;

constexpr auto kAnswer = 2ms;
constexpr double kRest = 0.1; // a six-axis mouse that says nothing so long is at rest [s]
constexpr std::size_t kLargestReport = 64;

using Report = std::array<std::byte, kLargestReport>;

// waits for one report, then takes what else is queued, and gives each to its reader
template <typename Take>
IoCode drain(Transport& transport, std::chrono::microseconds wait, const Take& take) noexcept
{
  constexpr int kQueued = 64; // as many as the kernel keeps
  IoCode answer = IoCode::Timeout;
  for (int i = 0; i < kQueued; ++i)
  {
    Report report{};
    const IoResult result = transport.read(report, i == 0 ? wait : 0us);
    if (result.code != IoCode::Ok)
    {
      return result.code == IoCode::Gone ? IoCode::Gone : answer;
    }
    if (take(Bytes(report).first(std::min(result.size, report.size()))))
    {
      answer = IoCode::Ok;
    }
  }
  return answer;
}

// on the wire of HID, a report without a number begins with 0
template <typename Payload>
IoCode writeReport(Transport& transport, const Payload& payload) noexcept
{
  std::array<std::byte, kLargestReport + 1> numbered{};
  std::copy(payload.begin(), payload.end(), numbered.begin() + 1);
  return transport.write(Bytes(numbered).first(payload.size() + 1));
}

} // namespace

SpaceMouseDriver::SpaceMouseDriver(std::unique_ptr<Transport> transport, const RateControl& rate)
  : transport_(std::move(transport))
  , rate_(rate)
{
}

DeviceLimits SpaceMouseDriver::limits() const
{
  return { .model = "SpaceMouse" };
}

IoCode SpaceMouseDriver::tick(const Eigen::Vector3d&, double dt, DriverSample& sample) noexcept
{
  const IoCode code =
    drain(*transport_, 0us, [&](Bytes report) { return takeSpaceMouseReport(report, state_); });
  if (code == IoCode::Gone)
  {
    return code;
  }
  silent_ = code == IoCode::Ok ? 0.0 : silent_ + dt;
  if (silent_ > kRest) // a report of rest that was lost must not leave the tool drifting
  {
    state_.axes = {};
  }
  position_ += dt * velocityOf(state_, rate_);
  sample = { .position = position_, .buttons = state_.buttons, .homed = true };
  return IoCode::Ok;
}

WoodenDriver::WoodenDriver(
  std::unique_ptr<Transport> transport, const WoodenArm& arm, std::size_t reportSize)
  : transport_(std::move(transport))
  , arm_(arm)
  , reportSize_(std::min(reportSize, kLargestReport))
{
}

DeviceLimits WoodenDriver::limits() const
{
  return { .model = "WoodenHaptics",
    .rendersForce = true,
    .needsHoming = true,
    .maxForce = arm_.maxForce,
    .damping = arm_.damping,
    .quantum = 54.0_um,
    .delay = 1.0_ms,
    .velocityDelay = 4.5_ms,
    .workspaceRadius = arm_.radius };
}

IoCode WoodenDriver::tick(const Eigen::Vector3d& force, double, DriverSample& sample) noexcept
{
  Report command{};
  const MutableBytes payload = MutableBytes(command).first(reportSize_);
  if (calibrate_)
  {
    encodeWoodenCalibration(arm_, payload);
    calibrate_ = false; // once: by the next tick the arm may have left
    told_ = true;
  }
  else
  {
    encodeWooden(homed_ ? motorCurrents(arm_, angles_, force) : std::array<double, 3>{}, payload);
  }
  if (writeReport(*transport_, payload) == IoCode::Gone)
  {
    return IoCode::Gone;
  }
  const IoCode code = drain(*transport_, kAnswer,
    [&](Bytes report)
    {
      const auto heard = decodeWooden(report);
      if (heard)
      {
        angles_ = jointAngles(arm_, heard->encoders);
        calibrate_ = heard->calibrate;
        homed_ = told_ && !calibrate_;
      }
      return heard.has_value();
    });
  if (code == IoCode::Ok)
  {
    sample = { .position = forwardKinematics(arm_, angles_), .homed = homed_ };
  }
  return code;
}

Phd1Driver::Phd1Driver(std::unique_ptr<Transport> transport)
  : transport_(std::move(transport))
{
}

DeviceLimits Phd1Driver::limits() const
{
  return { .model = "PHD1 board",
    .rendersForce = true,
    .needsHoming = true,
    .maxForce = 4.0,
    .damping = 0.2,
    .quantum = 10.0_um,
    .delay = 1.0_ms,
    .velocityDelay = 4.5_ms,
    .workspaceRadius = 100.0_mm };
}

IoCode Phd1Driver::tick(const Eigen::Vector3d& force, double, DriverSample& sample) noexcept
{
  const bool ready = state_.homed && !state_.stopped;
  Phd1Command command{ .order = ready ? Phd1Order::Force
      : state_.stopped                ? Phd1Order::Idle
                                      : Phd1Order::Home,
    .sequence = sequence_++ };
  if (ready)
  {
    command.force = force;
  }
  if (writeReport(*transport_, encode(command)) == IoCode::Gone)
  {
    return IoCode::Gone;
  }
  const IoCode code = drain(*transport_, kAnswer,
    [&](Bytes report)
    {
      const auto heard = decodePhd1State(report);
      state_ = heard.value_or(state_);
      return heard.has_value();
    });
  if (code == IoCode::Ok)
  {
    sample = { .position = state_.position,
      .buttons = state_.buttons,
      .homed = state_.homed,
      .stopped = state_.stopped };
  }
  return code;
}

} // namespace palp
