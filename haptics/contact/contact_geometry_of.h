#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/force_law.h"
#include "haptics/force/series/series_body.h"
#include "haptics/surface/surface_point.h"

namespace palp
{

/// What a force law needs to know of a contact.
[[nodiscard]] inline ContactGeometry contactGeometryOf(const Contact& contact) noexcept
{
  return { .depth = contact.depth,
    .tilt = contact.tilt,
    .thickness = contact.thickness,
    .surfaceCurvature = contact.surfaceCurvature,
    .curvatureSpread = contact.curvatureSpread,
    .normalSpread = contact.normalSpread,
    .hollow = contact.hollow };
}

/// Where the tool of a contact stands over a body that gives way as a whole.
[[nodiscard]] inline SeriesPlace seriesPlaceOf(const Contact& contact) noexcept
{
  return { .tool = contact.center + contact.height * contact.normal,
    .normal = contact.bodyNormal,
    .height = contact.height,
    .turning = contact.turning,
    .rising = contact.rising };
}

/// The same of a place that a tool only just touches, straight on; its depth does not count.
[[nodiscard]] ContactGeometry geometryAt(
  const Surface& surface, const Tip& tip, const SurfacePoint& place) noexcept;

} // namespace palp
