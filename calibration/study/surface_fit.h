#pragma once

#include "calibration/fem/indenter.h"
#include "calibration/tables/surface_profile.h"

#include <cmath>

namespace palp::fem
{

/// How far a curve lies from the surface of the finite elements, outside the contact.
struct SurfaceError
{
  double rms = 0.0;     ///< over the radius [m]
  double largest = 0.0; ///< [m]
};

/// The curve nearest to the surface of a pressed body, which ends at the body's edge; its control
/// values by least squares over the radius.
/// @throws Error  BadValue: fewer than eight surface points outside the contact
[[nodiscard]] SurfaceProfile fitSurface(const IndentationStep& pressed, const Tip& tip);

/// @param sinkAt  radius [m] to sink [m]
/// @param upTo    largest radius compared [m]
template <typename Function>
[[nodiscard]] SurfaceError surfaceError(
  const IndentationStep& pressed, double upTo, const Function& sinkAt)
{
  SurfaceError error;
  double sum = 0.0;
  double width = 0.0;
  for (std::size_t i = 1; i < pressed.profile.size(); ++i)
  {
    const auto& point = pressed.profile[i];
    const auto& before = pressed.profile[i - 1];
    const double radius = point.radius + point.ur;
    const double step = radius - before.radius - before.ur;
    if (radius <= pressed.contactRadius || radius > upTo)
    {
      continue;
    }
    const double off = sinkAt(radius) + point.uz;
    sum += step * off * off;
    width += step;
    error.largest = std::max(error.largest, std::abs(off));
  }
  error.rms = width > 0.0 ? std::sqrt(sum / width) : 0.0;
  return error;
}

/// The paper's curve for the same contact: a quadratic Bezier that ends at R_d with no sink.
/// @source  Eq. (8), Fig. 5(b)
[[nodiscard]] double paperSink(
  const Tip& tip, double depth, double contactRadius, double extentRadius, double radius);

} // namespace palp::fem
