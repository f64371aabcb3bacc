#include "haptics/devices/identify/unlike_axis.h"

#include <algorithm>
#include <array>

namespace palp
{

std::string unlikeAxis(const IdentifiedArm& arm)
{
  // WoodenHaptics, Polhem and AluHaptics lie below 3, with rotors of 3 to 5 g m^2 and 100 g at the
  // handle; counts that are wrong by 10 make an axis 10 times as light or as heavy
  constexpr double kMost = 6.0;
  std::array order{ 0, 1, 2 };
  const auto mass = [&](int axis) { return arm.axes[static_cast<std::size_t>(axis)].mass; };
  std::ranges::sort(order, {}, mass);
  const auto& [light, middle, heavy] = order;
  if (!arm.agrees() || mass(heavy) <= kMost * mass(light))
  {
    return "";
  }
  const bool isHeavy = mass(heavy) * mass(light) > mass(middle) * mass(middle);
  const char name = "xyz"[isHeavy ? heavy : light];
  return std::string("along ") + name + " the arm is more than six times as " +
    (isHeavy ? "heavy" : "light") +
    " as along another axis, as no arm is; check the counts per turn in its configuration and the "
    "encoder that moves along " +
    name;
}

} // namespace palp
