#include "pipeline/deform/press_of.h"

#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kBetween = 12.0_deg; // normal and flank, at least

// how far the way down may lean from the axis: of a round tip its shaft is the first that can stand
// along it, of a punch its flat lies at the other side of that
double mostLean(const Tip& tip) noexcept
{
  return std::visit(
    [](const auto& shape)
    {
      if constexpr (requires { shape.halfAngle; })
      {
        return std::max(0.0, shape.halfAngle - kBetween);
      }
      return std::is_same_v<std::decay_t<decltype(shape)>, PunchTip> ? 45.0_deg
                                                                     : 90.0_deg - kBetween;
    },
    tip);
}

} // namespace

Eigen::Vector3d drawnNormal(
  const Eigen::Vector3d& normal, const Eigen::Vector3d& axis, const Tip& tip) noexcept
{
  const double most = mostLean(tip);
  const double along = -normal.dot(axis);
  const Eigen::Vector3d across = normal + along * axis;
  const double length = across.norm();
  if (!(length > 0.0) || std::atan2(length, along) <= most)
  {
    return normal;
  }
  return std::sin(most) / length * across - std::cos(most) * axis;
}

} // namespace palp
