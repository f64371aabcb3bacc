#pragma once

#include "haptics/contact/contact.h"
#include "haptics/pose.h"
#include "haptics/surface/surface.h"
#include "haptics/tip/tip.h"

namespace palp
{

/// How much of a tool the paper's rule looks at, from its apex [m].
[[nodiscard]] double paperLength(const Tip& tip) noexcept;

/// The paper's rule: mesh points inside the tool, depth from their center along their mean normal.
///
/// Points that face away from the tool, on the far side of a thin lobe, do not count; nor does
/// what is above the base by more than four base radii. No point inside is no contact.
///
/// @source    Sec. 4.1
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Contact paperContact(
  const Surface& surface, const Tip& tip, const ToolPose& pose) noexcept;

} // namespace palp
