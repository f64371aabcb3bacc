#include "haptics/devices/falcon/falcon_driver.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;

// requests of the FTDI chip
// @source  libnifalcon FalconCommLibUSB.cpp; libftdi ftdi.h (SIO_TCIFLUSH, SIO_TCOFLUSH), as facts
enum Request : std::uint8_t
{
  Reset = 0,
  Modem = 1,
  Flow = 2,
  Divisor = 3,
  Format = 4,
  EventCharacter = 6,
  Latency = 9,
};
constexpr std::uint16_t kPurgeIn = 2;  // what waits for the host
constexpr std::uint16_t kPurgeOut = 1; // what it has sent
constexpr std::uint16_t kDtrOn = 0x0101;
constexpr std::uint16_t kDtrOff = 0x0100;
constexpr std::uint16_t kRtsOff = 0x0200;
constexpr std::uint16_t kSlow = 0x4138;  // 9600 baud
constexpr std::uint16_t kLoading = 0x15; // 140 kbaud
constexpr std::uint16_t kNormal = 0x2;   // 1.4 Mbaud
constexpr std::uint16_t kEightBits = 8;
// a packet's last byte, on: the chip hands a reply over at once instead of when its timer runs out
// @source  libftdi ftdi_set_event_char; FTDI AN232B-04, as facts
constexpr std::uint16_t kAtLast = 0x0100 | '>';

constexpr std::size_t kStatusBytes = 2; // before the data of each packet of the chip
constexpr std::size_t kChunk = 62;
constexpr int kLoadAttempts = 10;
constexpr int kGreetings = 10; // in each: without its power supply it would take minutes otherwise

// motor counts for a torque: not calibrated, and low on purpose until somebody weighs it
// @source  ratio of the traces in libnifalcon's translate_packet.py
constexpr double kCountsPerTorque = 2300.0; // [1/(N m)]
constexpr double kLargestCount = 4096.0;

// lights that tell the user what to do, and how far out a homed grip is pulled before it pushes
// @source  vrpn_Tracker_NovintFalcon.C, as facts
constexpr std::uint8_t kRed = 0x8;   // home it
constexpr std::uint8_t kBlue = 0x4;  // pull it out once
constexpr std::uint8_t kGreen = 0x2; // ready
const Eigen::Matrix3d kFacing{ { 1.0, 0.0, 0.0 }, { 0.0, 0.0, -1.0 },
  { 0.0, 1.0, 0.0 } };               // its y is up, its z to the user
constexpr double kPulledOut = 0.170; // z of its frame [m]

constexpr int kPurges = 3; // exchanges that begin with one: a late reply may come after the first

using Packet = std::array<std::byte, 64>;

constexpr std::array kGreeting{ std::byte{ 0x0A }, std::byte{ 0x43 }, std::byte{ 0x0D } };
constexpr std::array kGreeted{ std::byte{ 0x0A }, std::byte{ 0x44 }, std::byte{ 0x2C },
  std::byte{ 0x0D } };
constexpr std::array kStartLoading{ std::byte{ 0x41 } };

} // namespace

FalconDriver::FalconDriver(
  std::unique_ptr<SerialTransport> transport, const std::vector<std::byte>& firmware)
  : transport_(std::move(transport))
{
  if (enterNormalMode() && answers())
  {
    return;
  }
  if (firmware.empty())
  {
    throw Error(ErrorCode::NoDevice,
      "Novint Falcon: has no firmware since it was switched on; give your copy as --device "
      "falcon:FILE");
  }
  for (int attempt = 0; attempt < kLoadAttempts; ++attempt)
  {
    if (load(firmware) && enterNormalMode() && answers())
    {
      return;
    }
  }
  throw Error(ErrorCode::NoDevice,
    "Novint Falcon: its firmware could not be loaded; check its power supply, or try another file");
}

bool FalconDriver::request(std::uint8_t what, std::uint16_t value) noexcept
{
  return transport_->request(what, value);
}

bool FalconDriver::enterNormalMode() noexcept
{
  return request(Latency, 1) && request(EventCharacter, kAtLast) && request(Divisor, kNormal) &&
    request(Reset, kPurgeIn) && request(Reset, kPurgeOut);
}

bool FalconDriver::answers() noexcept
{
  std::optional<FalconState> state;
  for (int i = 0; i < 3 && !state; ++i)
  {
    if (exchange(FalconCommand{}, state, 20ms) == IoCode::Gone)
    {
      return false;
    }
  }
  return state.has_value();
}

// the boot loader echoes each byte
bool FalconDriver::load(const std::vector<std::byte>& firmware) noexcept
{
  bool ready = request(Reset, kPurgeIn) && request(Reset, kPurgeOut) && request(Latency, 16) &&
    request(Divisor, kSlow) && request(Format, kEightBits) && request(Flow, 0) &&
    request(Modem, kRtsOff) && request(Modem, kDtrOff) && request(Modem, kDtrOn);
  for (int i = 0; ready && !sendAndExpect(kGreeting, kGreeted); ++i)
  {
    ready = i < kGreetings;
  }
  if (!ready || !request(Modem, kDtrOff) || !request(Divisor, kLoading) ||
    !sendAndExpect(kStartLoading, kStartLoading))
  {
    return false;
  }
  for (std::size_t done = 0; done < firmware.size(); done += kChunk)
  {
    const Bytes chunk = Bytes(firmware).subspan(done, std::min(kChunk, firmware.size() - done));
    if (!sendAndExpect(chunk, chunk))
    {
      return false;
    }
  }
  return true;
}

bool FalconDriver::sendAndExpect(Bytes sent, Bytes expected) noexcept
{
  if (transport_->write(sent) != IoCode::Ok)
  {
    return false;
  }
  constexpr int kReads = 8;
  for (int i = 0; i < kReads && !expected.empty(); ++i)
  {
    Packet packet{};
    const IoResult result = transport_->read(packet, 100ms);
    if (result.code != IoCode::Ok)
    {
      return false;
    }
    const Bytes data =
      Bytes(packet).first(std::max(result.size, kStatusBytes)).subspan(kStatusBytes);
    if (data.size() > expected.size() || !std::ranges::equal(data, expected.first(data.size())))
    {
      return false;
    }
    expected = expected.subspan(data.size());
  }
  return expected.empty();
}

// each packet has one reply, which does not say whose it is: once one comes late, it and those
// after it would be taken for the next
IoCode FalconDriver::exchange(const FalconCommand& command, std::optional<FalconState>& state,
  std::chrono::microseconds wait) noexcept
{
  if (purges_ > 0)
  {
    (void)request(Reset, kPurgeIn);
  }
  const int purges = std::exchange(purges_, kPurges); // unless this reply is in time
  if (transport_->write(encode(command)) == IoCode::Gone)
  {
    return IoCode::Gone;
  }
  constexpr int kReads = 4; // replies come split, and packets come without any
  for (int i = 0; i < kReads && !state; ++i)
  {
    Packet packet{};
    const IoResult result = transport_->read(packet, wait);
    if (result.code != IoCode::Ok)
    {
      return result.code;
    }
    if (result.size > kStatusBytes)
    {
      state = reader_.take(Bytes(packet).first(result.size).subspan(kStatusBytes));
    }
  }
  if (!state)
  {
    return IoCode::Timeout;
  }
  purges_ = std::max(0, purges - 1);
  return IoCode::Ok;
}

DeviceLimits FalconDriver::limits() const
{
  return { .model = "Novint Falcon",
    .rendersForce = true,
    .needsHoming = true,
    .maxForce = 8.0,
    .damping = 0.2,
    .friction = 0.05, // less than any has, unless identified
    .handDamping = kGripDamping,
    .quantum = 48.0_um,
    .delay = 1.0_ms,
    .velocityDelay = 4.5_ms,
    .workspaceRadius = 40.0_mm,
    .unproven = true,
    .facing = kFacing };
}

IoCode FalconDriver::tick(const Wrench& wrench, double, DriverSample& sample) noexcept
{
  FalconCommand command{ .homing = true, .lights = homed_ ? kGreen : counted_ ? kBlue : kRed };
  const auto torques = homed_ ? falconTorques(position_, wrench.force) : std::nullopt;
  Eigen::Vector3d sent = Eigen::Vector3d::Zero();
  if (torques)
  {
    const Eigen::Vector3d counts = -kCountsPerTorque * *torques;
    const double largest = counts.cwiseAbs().maxCoeff();
    const double fraction = largest > kLargestCount ? kLargestCount / largest : 1.0;
    sent = fraction * wrench.force;
    for (std::size_t i = 0; i < 3; ++i)
    {
      command.torque[i] = nearestInt<std::int16_t>(fraction * counts[static_cast<int>(i)]);
    }
  }
  sample.sent = sent;
  std::optional<FalconState> state;
  const IoCode code = exchange(command, state, 2ms);
  if (code != IoCode::Ok)
  {
    return code;
  }
  const Eigen::Vector3d angles{ falconAngle(state->encoder[0]), falconAngle(state->encoder[1]),
    falconAngle(state->encoder[2]) };
  auto position = falconPosition(angles, position_);
  position = position ? position : falconPosition(angles, falconCenter());
  counted_ = state->homed;
  position_ = position.value_or(position_);
  homed_ = counted_ && position && (homed_ || position_.z() > kPulledOut);
  sample = {
    .position = position_ - falconCenter(), .buttons = state->buttons, .homed = homed_, .sent = sent
  };
  return IoCode::Ok;
}

} // namespace palp
