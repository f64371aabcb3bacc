#pragma once

#include "haptics/material.h"

#include <array>
#include <cstddef>
#include <span>

namespace palp
{

/// A sheet of other tissue that is bonded to what lies below it: skin, fat, a capsule.
struct Coating
{
  double thickness; ///< [m]
  Material material;
};

/// The coatings of a body, from the surface down; in place, so that a law that carries them is
/// copied without allocation.
class Coatings
{
public:
  static constexpr std::size_t kMost = 4;

  /// @throws Error  BadValue: one more than kMost, a thickness outside 10 um
  ///                to 1 m, or as makeMaterial
  void add(const Coating& coating);

  [[nodiscard]] std::span<const Coating> all() const noexcept
  {
    return { items_.data(), count_ };
  }
  [[nodiscard]] bool empty() const noexcept
  {
    return count_ == 0;
  }

  /// Of all together [m].
  [[nodiscard]] double thickness() const noexcept;

private:
  std::array<Coating, kMost> items_{};
  std::size_t count_ = 0;
};

} // namespace palp
