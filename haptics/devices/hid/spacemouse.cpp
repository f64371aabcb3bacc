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
  Eigen::Vector3d velocity;
  for (int i = 0; i < 3; ++i)
  {
    const double fraction =
      std::min(1.0, std::abs(state.axes[static_cast<std::size_t>(i)]) / kFullScale);
    const double beyond = std::max(0.0, fraction - rate.deadBand) / (1.0 - rate.deadBand);
    velocity[i] = std::copysign(
      rate.speed * std::pow(beyond, rate.exponent), state.axes[static_cast<std::size_t>(i)]);
  }
  return { velocity.x(), -velocity.y(), -velocity.z() };
}

} // namespace palp
