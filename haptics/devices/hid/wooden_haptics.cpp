#include "haptics/devices/hid/wooden_haptics.h"

#include "haptics/error.h"
#include "haptics/files/listed.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>
#include <sstream>
#include <utility>

namespace palp
{
namespace
{

constexpr std::size_t kReport = 14;
constexpr double kMilliampere = 0.001; // [A]

struct Key
{
  std::string_view name;
  std::span<double> values;
  double least; // what an arm on a desk can have; more or less is of another unit
  double most;
  std::string_view unit;
  bool given = false;
};

std::string_view nextWord(std::string_view& text)
{
  constexpr std::string_view kSpace = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kSpace));
  text.remove_prefix(word.size());
  return word;
}

// what is wrong with the values of a key and what to do, or nothing
std::string readValues(std::string_view text, const Key& key)
{
  std::ostringstream wrong;
  for (double& value : key.values)
  {
    const std::string_view word = nextWord(text);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
    {
      wrong << key.name << " takes " << (key.values.size() == 1 ? "one number" : "three numbers")
            << " in " << key.unit << ", with a decimal point and no unit behind";
      return wrong.str();
    }
    if (!(value >= key.least && value <= key.most))
    {
      wrong << key.name << " is " << word << "; give " << key.least << " to " << key.most << ' '
            << key.unit;
      return wrong.str();
    }
  }
  return nextWord(text).empty() ? "" : std::string(key.name) + " has more values than it takes";
}

// one key in a line
void readKeys(std::string_view text, std::span<Key> keys, const std::string& name)
{
  const auto refuse = [&](int line, const std::string& why)
  { throw Error(ErrorCode::BadFile, name + ":" + std::to_string(line) + ": " + why); };
  for (int line = 1; !text.empty(); ++line)
  {
    std::string_view row = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), row.size() + 1));
    row = row.substr(0, row.find('#'));
    const std::size_t equals = std::min(row.find('='), row.size());
    std::string_view front = row.substr(0, equals);
    const std::string_view word = nextWord(front);
    if (word.empty() && equals == row.size())
    {
      continue;
    }
    constexpr std::size_t kShown = 40; // of what may be a file of another kind
    const std::string shown(word.substr(0, kShown));
    if (equals == row.size() || !nextWord(front).empty())
    {
      refuse(line, "no = after " + shown + "; write as in: length = 0.080 0.205 0.245");
    }
    const auto key = std::ranges::find(keys, word, &Key::name);
    if (key == keys.end())
    {
      refuse(line, "unknown key '" + shown + "'; expected one of " + listed(keys, &Key::name));
    }
    row.remove_prefix(equals + 1);
    if (std::exchange(key->given, true))
    {
      refuse(line, std::string(word) + " is given twice; keep one of them");
    }
    if (const std::string wrong = readValues(row, *key); !wrong.empty())
    {
      refuse(line, wrong);
    }
  }
  if (std::ranges::none_of(keys, &Key::given))
  {
    throw Error(ErrorCode::BadFile,
      name + ": tells nothing of an arm; give at least one of " + listed(keys, &Key::name));
  }
}

} // namespace

std::optional<WoodenArm> publishedArm(std::string_view name) noexcept
{
  if (name == "v2015")
  {
    return WoodenArm{};
  }
  if (name == "v2019")
  {
    return WoodenArm{ .torque = { 0.321, 0.0603, 0.0603 } };
  }
  if (name == "polhem")
  {
    return WoodenArm{ .length = { 0.058, 0.174, 0.133 },
      .body = { 0.180, 0.100, 0.100 },
      .origin = { 0.140, 0.0, 0.100 },
      .torque = { 0.0538, 0.0538, 0.0538 },
      .sign = { -1.0, -1.0, -1.0 },
      .rest = { 0.0, 0.0, -5000.0 },
      .wrist = { 1024.0, 1024.0, 1024.0 },
      .wristSign = { -1.0, 1.0, -1.0 } };
  }
  if (name == "aluhaptics")
  {
    return WoodenArm{ .capstan = { 0.0138, 0.0098, 0.0098 },
      .length = { 0.111, 0.140, 0.111 },
      .body = { 0.116, 0.076, 0.076 },
      .origin = { 0.140, 0.0, 0.0 },
      .rest = { 0.0, 0.0, 0.0 } };
  }
  return std::nullopt;
}

WoodenArm parseWoodenArm(std::string_view text, const std::string& name)
{
  WoodenArm arm;
  std::array keys{ Key{ "capstan", arm.capstan, 0.001, 0.1, "m" },
    Key{ "length", arm.length, 0.01, 2.0, "m" }, Key{ "body", arm.body, 0.01, 1.0, "m" },
    Key{ "origin", arm.origin, -2.0, 2.0, "m" }, Key{ "torque", arm.torque, 0.001, 5.0, "N m/A" },
    Key{ "counts", arm.counts, 10.0, 1e6, "counts in a turn" },
    Key{ "sign", arm.sign, -100.0, 100.0, "1 or -1" },
    Key{ "rest", arm.rest, -32'768.0, 32'767.0, "counts" },
    Key{ "wrist", arm.wrist, 0.0, 1e6, "counts in a turn" },
    Key{ "wrist_sign", arm.wristSign, -100.0, 100.0, "1 or -1" },
    Key{ "radius", { &arm.radius, 1 }, 0.005, 1.0, "m" },
    Key{ "max_force", { &arm.maxForce, 1 }, 0.1, 50.0, "N" },
    Key{ "max_current", { &arm.maxCurrent, 1 }, 0.01, 20.0, "A" },
    Key{ "continuous_current", { &arm.continuousCurrent, 1 }, 0.01, 20.0, "A" },
    Key{ "peak_time", { &arm.peakTime, 1 }, 0.01, 60.0, "s" },
    Key{ "damping", { &arm.damping, 1 }, 0.001, 10.0, "N s/m" } };
  readKeys(text, keys, name);
  const auto isSign = [](double sign) { return std::abs(sign) == 1.0; };
  if (!std::ranges::all_of(arm.sign, isSign) || !std::ranges::all_of(arm.wristSign, isSign))
  {
    throw Error(ErrorCode::BadFile, name + ": a sign is neither 1 nor -1; give one of them");
  }
  if (arm.continuousCurrent >= arm.maxCurrent)
  {
    throw Error(ErrorCode::BadFile,
      name + ": continuous_current is not below max_current; give what a motor bears for ever");
  }
  for (const double count : arm.rest)
  {
    if (nearestInt<std::int16_t>(count) != count)
    {
      throw Error(ErrorCode::BadFile,
        name + ": rest is no whole number of counts from -32768 to 32767; give one");
    }
  }
  return arm;
}

std::optional<WoodenReport> decodeWooden(Bytes report) noexcept
{
  if (report.size() < kReport)
  {
    return std::nullopt;
  }
  WoodenReport decoded;
  for (std::size_t i = 0; i < decoded.encoders.size(); ++i)
  {
    decoded.encoders[i] = readInt<std::int16_t>(report, 2 * i);
  }
  decoded.calibrate = readInt<std::int16_t>(report, 12) == 1;
  constexpr std::int16_t kPressed = 5000;
  constexpr std::int16_t kButton = 10'000;
  decoded.button = decoded.encoders[3] > kPressed;
  if (decoded.button)
  {
    decoded.encoders[3] = static_cast<std::int16_t>(decoded.encoders[3] - kButton);
  }
  return decoded;
}

void encodeWooden(const std::array<double, 3>& currents, MutableBytes report) noexcept
{
  std::ranges::fill(report, std::byte{ 0 }); // command 0: run the currents
  for (std::size_t i = 0; i < currents.size(); ++i)
  {
    writeInt(report, 2 * i, nearestInt<std::int16_t>(currents[i] / kMilliampere));
  }
}

void encodeWoodenCalibration(const WoodenArm& arm, MutableBytes report) noexcept
{
  constexpr std::int16_t kSetCounters = 1;
  std::ranges::fill(report, std::byte{ 0 }); // the counters of a wrist, too
  for (std::size_t i = 0; i < 3; ++i)
  {
    writeInt(report, 8 + 2 * i, nearestInt<std::int16_t>(arm.rest[i]));
  }
  writeInt(report, 6, kSetCounters);
}

Eigen::Vector3d jointAngles(
  const WoodenArm& arm, const std::array<std::int16_t, 6>& encoders) noexcept
{
  Eigen::Vector3d angles;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double motor = 2.0 * std::numbers::pi * encoders[i] / arm.counts[i];
    angles[static_cast<int>(i)] = arm.sign[i] * motor * arm.capstan[i] / arm.body[i];
  }
  return angles;
}

Eigen::Vector3d forwardKinematics(const WoodenArm& arm, const Eigen::Vector3d& angles) noexcept
{
  const auto& [shoulder, upper, fore] = arm.length;
  const double reach = upper * std::sin(angles[1]) + fore * std::sin(angles[2]);
  return { std::cos(angles[0]) * reach - arm.origin[0], std::sin(angles[0]) * reach - arm.origin[1],
    shoulder + upper * std::cos(angles[1]) - fore * std::cos(angles[2]) - arm.origin[2] };
}

Eigen::Quaterniond wristOrientation(const WoodenArm& arm, const Eigen::Vector3d& angles,
  const std::array<std::int16_t, 6>& encoders) noexcept
{
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  constexpr double kRight = 0.5 * std::numbers::pi;
  Vector3d turns;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (!(arm.wrist[i] > 0.0))
    {
      return Eigen::Quaterniond::Identity();
    }
    turns[static_cast<int>(i)] =
      arm.wristSign[i] * 2.0 * std::numbers::pi * encoders[3 + i] / arm.wrist[i];
  }
  const Eigen::Quaterniond pen = AngleAxisd(angles[0], Vector3d::UnitZ()) *
    AngleAxisd(kRight - angles[2], Vector3d::UnitY()) * AngleAxisd(turns[0], Vector3d::UnitX()) *
    AngleAxisd(turns[1], Vector3d::UnitY()) * AngleAxisd(turns[2], Vector3d::UnitX());
  return pen * AngleAxisd(kRight, Vector3d::UnitY()); // whose x runs from tip to handle
}

Eigen::Matrix3d positionJacobian(const WoodenArm& arm, const Eigen::Vector3d& angles) noexcept
{
  const double upper = arm.length[1];
  const double fore = arm.length[2];
  const Eigen::Vector3d s = angles.array().sin();
  const Eigen::Vector3d c = angles.array().cos();
  const double reach = upper * s[1] + fore * s[2];
  Eigen::Matrix3d jacobian;
  jacobian.col(0) << -s[0] * reach, c[0] * reach, 0.0;
  jacobian.col(1) << upper * c[0] * c[1], upper * s[0] * c[1], -upper * s[1];
  jacobian.col(2) << fore * c[0] * c[2], fore * s[0] * c[2], fore * s[2];
  return jacobian;
}

MotorCurrents motorCurrents(
  const WoodenArm& arm, const Eigen::Vector3d& angles, const Eigen::Vector3d& force) noexcept
{
  MotorCurrents motors;
  motors.torques = positionJacobian(arm, angles).transpose() * force;
  const Eigen::Vector3d& torques = motors.torques;
  double largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double motor = torques[static_cast<int>(i)] * arm.sign[i] * arm.capstan[i] / arm.body[i];
    motors.currents[i] = motor / arm.torque[i];
    largest = std::fmax(largest, std::abs(motors.currents[i]));
  }
  const bool finite = torques.allFinite() && std::isfinite(largest);
  motors.share = !finite ? 0.0 : largest > arm.maxCurrent ? arm.maxCurrent / largest : 1.0;
  for (double& current : motors.currents)
  {
    current = motors.share > 0.0 ? current * motors.share : 0.0;
  }
  return motors;
}

} // namespace palp
