#pragma once

#include "app/report/document.h"
#include "app/report/effort.h"

namespace palp::report
{

// The parts of the report. Each may throw Interrupted, and Error where its data are missing.

/// Error of the force against the time of an evaluation, against programs of others.
[[nodiscard]] Section forceAgainstTime(const Effort& effort);

/// Error of the surface that is drawn, likewise.
[[nodiscard]] Section surfaceAgainstTime(const Effort& effort);

/// Fig. 3.
[[nodiscard]] Section curvature(const Effort& effort);

/// Eq. (7).
[[nodiscard]] Section inclination(const Effort& effort);

/// Fig. 7.
[[nodiscard]] Section profiles(const Effort& effort);

/// Fig. 8.
[[nodiscard]] Section extents(const Effort& effort);

/// Figs. 15 and 16.
[[nodiscard]] Section forces(const Effort& effort);

/// The methods that the paper compares with, stepped against the same tool: Fig. 12.
[[nodiscard]] Section dynamics(const Effort& effort);

/// Time of a step against the number of vertices, and memory: Table 1, Figs. 13 and 14.
[[nodiscard]] Section scaling(const Effort& effort);

/// Outcomes of the closed loop from soft tissue to a rigid wall.
[[nodiscard]] Section stability(const Effort& effort);

/// How late a servo thread wakes up on this machine.
[[nodiscard]] Section servo(const Effort& effort);

} // namespace palp::report
