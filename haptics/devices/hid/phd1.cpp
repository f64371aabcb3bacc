#include "haptics/devices/hid/phd1.h"

#include <cmath>

namespace palp
{
namespace
{

constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kStateCrc = 33;
constexpr std::size_t kCommandCrc = 14;
constexpr double kMicrometer = 1e-6; // [m]
constexpr double kMilli = 0.001;     // [N], [N s/m]
constexpr double kUnit = 32767.0;    // of an orientation

bool isValid(Bytes report, std::size_t crcAt) noexcept
{
  return report.size() >= crcAt + 2 && report[0] == std::byte{ 'P' } &&
    report[1] == std::byte{ 'H' } && report[2] == std::byte{ kVersion } &&
    readInt<std::uint16_t>(report, crcAt) == crc16(report.first(crcAt));
}

std::array<std::byte, kPhd1Report> begin(std::uint8_t fourth, std::uint16_t sequence) noexcept
{
  std::array<std::byte, kPhd1Report> report{ std::byte{ 'P' }, std::byte{ 'H' },
    std::byte{ kVersion }, std::byte{ fourth } };
  writeInt(report, 4, sequence);
  return report;
}

} // namespace

std::optional<Phd1State> decodePhd1State(Bytes report) noexcept
{
  if (!isValid(report, kStateCrc))
  {
    return std::nullopt;
  }
  Phd1State state;
  const auto flags = std::to_integer<std::uint8_t>(report[3]);
  state.homed = (flags & 1U) != 0;
  state.stopped = (flags & 2U) != 0;
  state.motorsOn = (flags & 4U) != 0;
  state.sequence = readInt<std::uint16_t>(report, 4);
  state.microseconds = readInt<std::uint32_t>(report, 6);
  for (std::size_t i = 0; i < 3; ++i)
  {
    state.position[static_cast<int>(i)] = readInt<std::int32_t>(report, 10 + 4 * i) * kMicrometer;
  }
  double norm = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    state.orientation[i] = readInt<std::int16_t>(report, 22 + 2 * i) / kUnit;
    norm = std::hypot(norm, state.orientation[i]);
  }
  for (double& part : state.orientation)
  {
    part = norm > 0.5 ? part / norm : (&part == state.orientation.data() ? 1.0 : 0.0);
  }
  state.buttons = readInt<std::uint16_t>(report, 30);
  state.temperature = std::to_integer<std::uint8_t>(report[32]);
  return state;
}

std::optional<Phd1Command> decodePhd1Command(Bytes report) noexcept
{
  if (!isValid(report, kCommandCrc) ||
    std::to_integer<std::uint8_t>(report[3]) > static_cast<std::uint8_t>(Phd1Order::Stop))
  {
    return std::nullopt;
  }
  Phd1Command command;
  command.order = static_cast<Phd1Order>(report[3]);
  command.sequence = readInt<std::uint16_t>(report, 4);
  for (std::size_t i = 0; i < 3; ++i)
  {
    command.force[static_cast<int>(i)] = readInt<std::int16_t>(report, 6 + 2 * i) * kMilli;
  }
  command.damping = readInt<std::uint16_t>(report, 12) * kMilli;
  return command;
}

std::array<std::byte, kPhd1Report> encode(const Phd1State& state) noexcept
{
  const int flags = (state.homed ? 1 : 0) | (state.stopped ? 2 : 0) | (state.motorsOn ? 4 : 0);
  auto report = begin(static_cast<std::uint8_t>(flags), state.sequence);
  writeInt(report, 6, state.microseconds);
  for (std::size_t i = 0; i < 3; ++i)
  {
    writeInt(report, 10 + 4 * i,
      nearestInt<std::int32_t>(state.position[static_cast<int>(i)] / kMicrometer));
  }
  for (std::size_t i = 0; i < 4; ++i)
  {
    writeInt(report, 22 + 2 * i, nearestInt<std::int16_t>(state.orientation[i] * kUnit));
  }
  writeInt(report, 30, state.buttons);
  report[32] = std::byte{ state.temperature };
  writeInt(report, kStateCrc, crc16(Bytes(report).first(kStateCrc)));
  return report;
}

std::array<std::byte, kPhd1Report> encode(const Phd1Command& command) noexcept
{
  auto report = begin(static_cast<std::uint8_t>(command.order), command.sequence);
  const Eigen::Vector3d force =
    command.force.allFinite() ? command.force : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const double largest = force.cwiseAbs().maxCoeff();
  const double shrink = std::fmin(1.0, 32.0 / std::fmax(largest, 1.0)); // keeps the direction
  for (std::size_t i = 0; i < 3; ++i)
  {
    writeInt(
      report, 6 + 2 * i, nearestInt<std::int16_t>(force[static_cast<int>(i)] * shrink / kMilli));
  }
  writeInt(report, 12, nearestInt<std::uint16_t>(command.damping / kMilli));
  writeInt(report, kCommandCrc, crc16(Bytes(report).first(kCommandCrc)));
  return report;
}

} // namespace palp
