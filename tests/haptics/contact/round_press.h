#pragma once

#include "haptics/contact/find_contact.h"
#include "haptics/units.h"

namespace palp::test
{

inline const Tip kRoundTip = SphereTip{ .radius = units::fromMillimeters(10.0) };

/// A contact of that tool, along its axis, so deep below a place of the surface.
inline Contact pressed(
  const Surface& surface, const Eigen::Vector3d& place, double depth, const Eigen::Vector3d& way)
{
  return findContact(
    surface, kRoundTip, { .apex = place + depth * way, .axis = way }, ContactRule::Exact);
}

} // namespace palp::test
