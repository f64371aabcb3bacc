#include "haptics/force/energy_slopes.h"

#include "haptics/force/inclination.h"

#include <cmath>

namespace palp
{
namespace
{

constexpr double kChange = 1e-3; // by which each is changed, of the tool's curvature and itself

// Where the slope of a force is taken, and by how much its integral over the depth is more: exact
// where it grows as the depth's power of 1.5 or 3, and to 4 % from 1.5 to 3.5.
constexpr double kDepth = 0.7310; // [-]
constexpr double kWeight = 0.64;  // [-]

} // namespace

EnergySlopes energySlopes(const ForceLaw& law, const ContactGeometry& local) noexcept
{
  if (law.settings().mode != LawMode::Corrected || !(local.depth > 0.0))
  {
    return {};
  }
  ContactGeometry here = local;
  here.depth = kDepth * local.depth;
  const double force = law(here).force;
  // over one of its values
  const auto slope = [&](double ContactGeometry::*what, double change)
  {
    ContactGeometry there = here;
    there.*what += change;
    return kWeight * local.depth * (law(there).force - force) / change;
  };
  const double bend = kChange / baseRadius(law.tip());
  EnergySlopes slopes;
  if (law.settings().curvature && !(flatRadius(law.tip()) > 0.0))
  {
    slopes.curvature = slope(&ContactGeometry::surfaceCurvature, bend);
    ContactGeometry longer = here; // in one direction, which is a factor of the force
    longer.curvatureSpread += bend;
    slopes.spread =
      kWeight * local.depth * force * (law.ellipse(longer) / law.ellipse(here) - 1.0) / bend;
  }
  if (law.settings().inclination && std::isfinite(local.tilt))
  {
    const double factor = tiltFactor(law.tip(), local.tilt);
    slopes.tilt = kWeight * local.depth * force *
      (tiltFactor(law.tip(), local.tilt + kChange) / factor - 1.0) / kChange;
  }
  if (law.settings().thickness && std::isfinite(local.thickness))
  {
    slopes.thickness = slope(&ContactGeometry::thickness, kChange * local.thickness);
  }
  return slopes;
}

} // namespace palp
