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
constexpr std::size_t kLargestReport = 64;

using Report = std::array<std::byte, kLargestReport>;

constexpr double kFriction = 0.05; // of a cable drive, unless identified: less than any has [N]

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

SpaceMouseDriver::SpaceMouseDriver(
  std::vector<std::unique_ptr<Transport>> transports, const RateControl& rate)
  : transports_(std::move(transports))
  , motion_(rate)
{
}

SpaceMouseDriver::SpaceMouseDriver(std::unique_ptr<Transport> transport, const RateControl& rate)
  : motion_(rate)
{
  transports_.push_back(std::move(transport));
}

DeviceLimits SpaceMouseDriver::limits() const
{
  return { .model = "SpaceMouse" };
}

IoCode SpaceMouseDriver::tick(const Wrench&, double dt, DriverSample& sample) noexcept
{
  bool heard = false;
  std::size_t gone = 0;
  for (const auto& transport : transports_)
  {
    const IoCode code =
      drain(*transport, 0us, [&](Bytes report) { return takeSpaceMouseReport(report, state_); });
    heard = heard || code == IoCode::Ok;
    gone += code == IoCode::Gone ? 1 : 0;
  }
  if (gone == transports_.size())
  {
    return IoCode::Gone;
  }
  sample = motion_.move(state_, heard, dt);
  return IoCode::Ok;
}

WoodenDriver::WoodenDriver(
  std::unique_ptr<Transport> transport, const WoodenArm& arm, std::size_t reportSize)
  : transport_(std::move(transport))
  , arm_(arm)
  , reportSize_(std::min(reportSize, kLargestReport))
  , heat_(arm.maxCurrent, arm.continuousCurrent, arm.peakTime)
{
}

DeviceLimits WoodenDriver::limits() const
{
  return { .model = "WoodenHaptics",
    .rendersForce = true,
    .needsHoming = true,
    .maxForce = arm_.maxForce,
    .damping = arm_.damping,
    .friction = kFriction,
    .handDamping = kGripDamping,
    .quantum = 54.0_um,
    .delay = 1.0_ms,
    .velocityDelay = 4.5_ms,
    .workspaceRadius = arm_.radius,
    .unproven = true,
    .facing = kFacesUser };
}

IoCode WoodenDriver::tick(const Wrench& wrench, double dt, DriverSample& sample) noexcept
{
  Report command{};
  const MutableBytes payload = MutableBytes(command).first(reportSize_);
  Eigen::Vector3d sent = Eigen::Vector3d::Zero();
  Eigen::Vector3d torques = Eigen::Vector3d::Zero();
  if (calibrate_)
  {
    encodeWoodenCalibration(arm_, payload);
    calibrate_ = false; // once: by the next tick the arm may have left
    told_ = true;
  }
  else
  {
    auto motors = homed_ ? motorCurrents(arm_, angles_, wrench.force) : MotorCurrents{};
    const double share = motors.share * heat_.take(motors.currents, dt);
    if (share > 0.0) // its share of NaN is none, too
    {
      sent = share * wrench.force;
      torques = share * motors.torques;
    }
    encodeWooden(motors.currents, payload);
  }
  sample.sent = sent;
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
        orientation_ = wristOrientation(arm_, angles_, heard->encoders);
        calibrate_ = heard->calibrate;
        homed_ = told_ && !calibrate_;
        button_ = heard->button;
      }
      return heard.has_value();
    });
  if (code == IoCode::Ok)
  {
    sample = { .position = forwardKinematics(arm_, angles_),
      .orientation = orientation_,
      .buttons = button_ ? 1U : 0U,
      .homed = homed_,
      .heat = heat_.fraction(),
      .sent = sent,
      .joints = DriverJoints{ angles_, torques } };
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
    .handDamping = kGripDamping,
    .quantum = 10.0_um,
    .delay = 1.0_ms,
    .velocityDelay = 4.5_ms,
    .workspaceRadius = 100.0_mm,
    .unproven = true };
}

IoCode Phd1Driver::tick(const Wrench& wrench, double, DriverSample& sample) noexcept
{
  const bool ready = state_.homed && !state_.stopped;
  const bool homing = homes_ && heard_ && !state_.homed && !state_.stopped;
  Phd1Command command{ .order = ready ? Phd1Order::Force
      : homing                        ? Phd1Order::Home
                                      : Phd1Order::Idle,
    .sequence = sequence_++ };
  if (ready)
  {
    command.force = wrench.force;
  }
  const auto told = encode(command);
  const Eigen::Vector3d sent = decodePhd1Command(told)->force; // as it stands on the wire
  sample.sent = sent;
  if (writeReport(*transport_, told) == IoCode::Gone)
  {
    return IoCode::Gone;
  }
  const IoCode code = drain(*transport_, kAnswer,
    [&](Bytes report)
    {
      const auto heard = decodePhd1State(report);
      const bool isNew = heard &&
        (!heard_ ||
          (heard->sequence != state_.sequence && heard->microseconds != state_.microseconds));
      if (isNew)
      {
        state_ = *heard;
        heard_ = true;
      }
      return isNew;
    });
  if (code == IoCode::Ok)
  {
    const auto& [w, x, y, z] = state_.orientation;
    sample = { .position = state_.position,
      .orientation = { w, x, y, z },
      .buttons = state_.buttons,
      .homed = state_.homed,
      .stopped = state_.stopped,
      .temperature = static_cast<double>(state_.temperature),
      .sent = sent };
  }
  return code;
}

// behind the number of the report: seven words of which the first three are currents, command 0
ZeroPacket woodenZero(std::size_t reportSize) noexcept
{
  return { .size = reportSize + 1, .from = 1, .to = 7 };
}

ZeroPacket phd1Zero() noexcept
{
  ZeroPacket zero{ .size = kPhd1Report + 1, .from = 7, .to = 13 };
  const auto idle = encode(Phd1Command{ .order = Phd1Order::Idle });
  std::ranges::copy(idle, zero.bytes.begin() + 1);
  return zero;
}

} // namespace palp
