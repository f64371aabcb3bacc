#pragma once

#include "haptics/tip/tip.h"

#include <array>

namespace palp
{

/// Pressure under a rigid frictionless tip, as the method of dimensionality reduction gives it.
///
/// Its shape is that of a half-space with the given contact radius; its height is such that the
/// pressure adds up to the force, whatever law that force came from.
///
/// @source method of dimensionality reduction: Popov and Hess 2015; sphere: Hertz 1881; cone:
///         Love 1939; flat punch: Boussinesq 1885
class ContactPressure
{
public:
  /// No pressure anywhere.
  ContactPressure() = default;

  /// @param tip            checked
  /// @param depth          delta [m]
  /// @param contactRadius  r [m], at most the base radius
  /// @param force          F [N]
  ContactPressure(const Tip& tip, double depth, double contactRadius, double force);

  /// @param radius  distance from the contact's center [m], 0 or more
  /// @return        p [Pa], 0 outside the contact; where the theory is infinite, at a sharp apex
  ///                and at the edge of a flat base, the value of a small distance from there
  [[nodiscard]] double at(double radius) const noexcept;

private:
  static constexpr std::size_t kRows = 129;

  double contactRadius_ = 0.0; // [m]
  std::array<double, kRows>
    pressure_{}; // at evenly spaced angles asin(radius / contact radius) [Pa]
};

} // namespace palp
