#pragma once

#include "app/report/document.h"
#include "app/report/effort.h"

namespace palp::report
{

/// Error of the force over nodules and maps of stiffness against the time of an evaluation, by
/// programs of others.
/// @throws Interrupted
/// @throws Error  BadFile: a table of reference is missing
[[nodiscard]] Section tissueAgainstTime(const Effort& effort);

} // namespace palp::report
