#pragma once

#include "haptics/stability/stability.h"

#include <iosfwd>
#include <span>

namespace palp
{

/// A judged case, through the chain and without.
struct JudgedCase
{
  StabilityCase what;
  StabilityRow chain;
  StabilityRow bare;
};

/// Name of an outcome, as in the files: stable, limited, refused, unstable.
[[nodiscard]] const char* nameOf(StabilityOutcome outcome);

/// Draws the outcomes as SVG: Young's modulus across, what was varied down, the worst of all tools
/// and Poisson's ratios in each cell; on the left without the chain, on the right with it.
void drawStabilityMap(std::ostream& out, std::span<const JudgedCase> cases);

} // namespace palp
