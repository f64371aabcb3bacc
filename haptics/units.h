#pragma once

// Every double in this code base is SI: m, N, Pa, s, rad.
// Millimeters, kilopascals and degrees live at the edges, and reach the inside through here.

#include <cstdio>
#include <numbers>
#include <string>

namespace palp::units
{

constexpr double toMicrometers(double meters) noexcept
{
  return 1e6 * meters;
}

constexpr double toMillimeters(double meters) noexcept
{
  return meters * 1e3;
}

/// For messages, as in `0.5 mm`.
inline std::string inMillimeters(double meters)
{
  char text[32];
  std::snprintf(text, sizeof text, "%g mm", toMillimeters(meters));
  return text;
}

constexpr double fromMillimeters(double millimeters) noexcept
{
  return millimeters / 1e3;
}

constexpr double toMilliliters(double cubicMeters) noexcept
{
  return cubicMeters * 1e6;
}

constexpr double toKilopascals(double pascals) noexcept
{
  return pascals / 1e3;
}

constexpr double fromKilopascals(double kilopascals) noexcept
{
  return kilopascals * 1e3;
}

constexpr double toDegrees(double radians) noexcept
{
  return radians * 180.0 / std::numbers::pi;
}

constexpr double fromDegrees(double degrees) noexcept
{
  return degrees * std::numbers::pi / 180.0;
}

/// [N/m] to [N/mm]
constexpr double toNewtonsPerMillimeter(double newtonsPerMeter) noexcept
{
  return newtonsPerMeter / 1e3;
}

constexpr double toMilliseconds(double seconds) noexcept
{
  return seconds * 1e3;
}

constexpr double toMicrojoules(double joules) noexcept
{
  return joules * 1e6;
}

inline namespace literals
{

// The product is taken in long double so that 10.0_mm is exactly the double 0.01.
constexpr double operator""_mm(long double value) noexcept
{
  return static_cast<double>(value * 1e-3L);
}

constexpr double operator""_um(long double value) noexcept
{
  return static_cast<double>(value * 1e-6L);
}

constexpr double operator""_ms(long double value) noexcept
{
  return static_cast<double>(value * 1e-3L);
}

constexpr double operator""_kPa(long double value) noexcept
{
  return static_cast<double>(value * 1e3L);
}

constexpr double operator""_MPa(long double value) noexcept
{
  return static_cast<double>(value * 1e6L);
}

constexpr double operator""_deg(long double value) noexcept
{
  return static_cast<double>(value * std::numbers::pi_v<long double> / 180.0L);
}

} // namespace literals
} // namespace palp::units
