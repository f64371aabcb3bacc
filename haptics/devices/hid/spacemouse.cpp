#include "haptics/devices/hid/spacemouse.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kFullScale = 350.0;

enum ReportId : std::uint8_t
{
  Translation = 1, // with the rotation behind it in long reports
  Rotation = 2,
  Buttons = 3,
};

constexpr std::size_t kShort = 7;
constexpr std::size_t kLong = 13;

void takeAxes(Bytes report, std::size_t count, std::int16_t* axes) noexcept
{
  for (std::size_t i = 0; i < count; ++i)
  {
    axes[i] = readInt<std::int16_t>(report, 1 + 2 * i);
  }
}

// of three axes from the first on, -1 to 1 each, in a frame with x right, y up the table, z up
Eigen::Vector3d deflection(
  const SpaceMouseState& state, std::size_t first, const RateControl& rate) noexcept
{
  Eigen::Vector3d shaped;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double axis = state.axes[first + i];
    const double fraction = std::min(1.0, std::abs(axis) / kFullScale);
    const double beyond = std::max(0.0, fraction - rate.deadBand) / (1.0 - rate.deadBand);
    shaped[static_cast<int>(i)] = std::copysign(std::pow(beyond, rate.exponent), axis);
  }
  return { shaped.x(), -shaped.y(), -shaped.z() };
}

} // namespace

bool takeSpaceMouseReport(Bytes report, SpaceMouseState& state) noexcept
{
  if (report.size() < 2)
  {
    return false;
  }
  switch (std::to_integer<std::uint8_t>(report[0]))
  {
    case Translation:
      if (report.size() < kShort)
      {
        return false;
      }
      takeAxes(report, report.size() >= kLong ? 6 : 3, state.axes.data());
      return true;
    case Rotation:
      if (report.size() < kShort)
      {
        return false;
      }
      takeAxes(report, 3, state.axes.data() + 3);
      return true;
    case Buttons:
      state.buttons = 0;
      for (std::size_t i = 1; i < std::min<std::size_t>(report.size(), 5); ++i)
      {
        state.buttons |= std::to_integer<std::uint32_t>(report[i]) << (8 * (i - 1));
      }
      return true;
    default:
      return false;
  }
}

Eigen::Vector3d velocityOf(const SpaceMouseState& state, const RateControl& rate) noexcept
{
  return rate.speed * deflection(state, 0, rate);
}

Eigen::Vector3d angularVelocityOf(const SpaceMouseState& state, const RateControl& rate) noexcept
{
  return rate.turning * deflection(state, 3, rate);
}

} // namespace palp
