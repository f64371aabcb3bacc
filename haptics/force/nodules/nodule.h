#pragma once

#include <string>

namespace palp
{

/// A ball of another stiffness in the tissue, bonded to it, of the same Poisson's ratio.
struct Nodule
{
  double radius; ///< b [m], 0.1 mm to 0.1 m
  double top;    ///< depth of its highest point below the surface [m], 10 um to 1 m
  double ratio;  ///< k, its Young's modulus over that of the tissue [-], 0.2 to 50

  /// Depth of its center [m].
  [[nodiscard]] constexpr double depth() const noexcept
  {
    return top + radius;
  }
};

/// A nodule whose values were checked.
/// @param what    stands before the message
/// @throws Error  BadValue: one is outside its range, or not a number; names it and the range
[[nodiscard]] Nodule checkedNodule(const Nodule& nodule, const std::string& what = "nodule");

} // namespace palp
