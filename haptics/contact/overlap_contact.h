#pragma once

#include "haptics/contact/contact.h"
#include "haptics/pose.h"
#include "haptics/surface/surface.h"
#include "haptics/tip/tip.h"

namespace palp
{

/// Contact of a tool without a round nose: as deep as a smooth body would be that has as much in
/// common with it, by volume, or by lift where it has a flat.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Contact overlapContact(
  const Surface& surface, const Tip& tip, const ToolPose& pose, CurvatureOf of) noexcept;

} // namespace palp
