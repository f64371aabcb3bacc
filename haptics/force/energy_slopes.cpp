#include "haptics/force/energy_slopes.h"

#include "haptics/force/inclination.h"

#include <cmath>

namespace palp
{
namespace
{

constexpr double kChange = 1e-4; // by which each is changed, of the tool's curvature and itself

// Where the slope of a force is taken, by the depth, and its integral over that, by the slope
// there.
struct Middle
{
  double depth;  // [-]
  double weight; // [-]
};

// By the power of the depth that such a slope is: exact for the first and the last, and to 3 %
// between.
constexpr Middle kFlat{ .depth = 2.0 / 3.0, .weight = 0.75 };      // 1 to 2, under a flat
constexpr Middle kRound{ .depth = 0.7310, .weight = 0.64 };        // 1.5 to 3
constexpr Middle kPointed{ .depth = 0.75, .weight = 16.0 / 27.0 }; // 2 to 3

const Middle& middleOf(const Tip& tip) noexcept
{
  return flatRadius(tip) > 0.0 ? kFlat : noseRadius(tip) > 0.0 ? kRound : kPointed;
}

} // namespace

EnergySlopes energySlopes(const ForceLaw& law, const ContactGeometry& local) noexcept
{
  if (law.settings().mode != LawMode::Corrected || !(local.depth > 0.0))
  {
    return {};
  }
  const Middle& middle = middleOf(law.tip());
  const double reach = middle.weight * local.depth;
  ContactGeometry here = local;
  here.depth = middle.depth * local.depth;
  const double force = law(here).force;
  // over one of its values
  const auto slope = [&](double ContactGeometry::*what, double change)
  {
    ContactGeometry there = here;
    there.*what += change;
    return reach * (law(there).force - force) / change;
  };
  const double bend = kChange / baseRadius(law.tip());
  EnergySlopes slopes;
  if (law.settings().curvature)
  {
    slopes.curvature = slope(&ContactGeometry::surfaceCurvature, bend);
    ContactGeometry longer = here; // in one direction, which is a factor of the force
    longer.curvatureSpread += bend;
    slopes.spread = reach * force * (law.ellipse(longer) / law.ellipse(here) - 1.0) / bend;
  }
  if (law.settings().inclination && std::isfinite(local.tilt))
  {
    const double factor = tiltFactor(law.tip(), local.tilt);
    slopes.tilt =
      reach * force * (tiltFactor(law.tip(), local.tilt + kChange) / factor - 1.0) / kChange;
  }
  if (law.settings().thickness && std::isfinite(local.thickness))
  {
    slopes.thickness = slope(&ContactGeometry::thickness, kChange * local.thickness);
  }
  return slopes;
}

} // namespace palp
