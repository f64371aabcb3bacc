#pragma once

#include "haptics/numerics/roots.h"
#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palp
{

/// The surface around a contact as finite elements show it: a Bezier curve over 1/radius.
///
/// 1/radius because a half-space sinks that way far from the tool. The curve continues the tool
/// and the rest surface without a corner (C1 at both ends); two control values are calibrated.
struct SurfaceProfile
{
  double inner = 0.0;              ///< contact radius [m]
  double outer = 0.0;              ///< where the rest surface begins [m], more than inner
  double sink = 0.0;               ///< of the surface at the inner radius [m]
  double slope = 0.0;              ///< of the tool there, outwards and up [-]
  std::array<double, 2> control{}; ///< free control values, the outer one first [m]
  double rest = 0.0;               ///< a sink of this or less is none [m], faded to from 2.5 times

  /// Depth of the surface below rest.
  ///
  /// @param radius  distance from the axis [m]; within the contact, the inner tangent goes on
  /// @return        [m], 0 beyond the outer radius
  /// @realtime      pure; no allocation, no lock, no exception
  [[nodiscard]] double sinkAt(double radius) const noexcept
  {
    if (!(radius < outer))
    {
      return 0.0;
    }
    if (radius <= inner)
    {
      return sink + slope * (inner - radius);
    }
    const auto weight = bernstein(parameter(radius));
    return faded(weight[2] * control[0] + weight[3] * control[1] + weight[4] * lastButOne() +
      weight[5] * sink);
  }

  /// Radius where the sink ends, the outer one at most [m].
  [[nodiscard]] double reach() const noexcept
  {
    const auto sinks = [this](double radius) { return sinkAt(radius) > 0.0; };
    return bisect(sinks, { inner, outer }, 30).high;
  }

  /// 0 at the outer end to 1 at the inner end, linear in 1/radius.
  [[nodiscard]] double parameter(double radius) const noexcept
  {
    return (inner / radius - inner / outer) / (1.0 - inner / outer);
  }

  /// Bernstein polynomials of degree 5; the first two carry no control value, which is what makes
  /// the outer end smooth.
  [[nodiscard]] static std::array<double, 6> bernstein(double t) noexcept
  {
    const double s = 1.0 - t;
    return { s * s * s * s * s, 5.0 * s * s * s * s * t, 10.0 * s * s * s * t * t,
      10.0 * s * s * t * t * t, 5.0 * s * t * t * t * t, t * t * t * t * t };
  }

  /// The control value that gives the curve the tool's slope at the inner end.
  [[nodiscard]] double lastButOne() const noexcept
  {
    return sink - slope * inner * (1.0 - inner / outer) / 5.0;
  }

private:
  // a tail of 1/radius has no end
  [[nodiscard]] double faded(double full) const noexcept
  {
    constexpr double kFadedFrom = 2.5;
    if (!(rest > 0.0) || full >= kFadedFrom * rest)
    {
      return full;
    }
    return full * smoothStep((full / rest - 1.0) / (kFadedFrom - 1.0));
  }
};

} // namespace palp
