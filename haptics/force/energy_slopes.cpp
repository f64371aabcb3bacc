#include "haptics/force/energy_slopes.h"

#include <cmath>

namespace palp
{
namespace
{

constexpr double kChange = 1e-3; // by which each is changed, of the tool's curvature and itself

// relative, of what a law makes of a place, over one of its values
template <typename Of>
double relativeSlope(
  const ContactGeometry& local, double ContactGeometry::*what, double change, Of of) noexcept
{
  ContactGeometry there = local;
  there.*what += change;
  return (of(there) / of(local) - 1.0) / change;
}

} // namespace

EnergySlopes energySlopes(
  const ForceLaw& law, const ContactGeometry& local, const Response& response) noexcept
{
  if (law.settings().mode != LawMode::Corrected || !(response.force > 0.0))
  {
    return {};
  }
  const double power = 1.0 + response.stiffness * local.depth / response.force;
  const double energy = response.force * local.depth / power;
  const double bend = kChange / baseRadius(law.tip());
  EnergySlopes slopes;
  if (law.settings().curvature && !(flatRadius(law.tip()) > 0.0))
  {
    const auto ellipse = [&](const ContactGeometry& at) { return law.ellipse(at); };
    slopes.spread = energy * relativeSlope(local, &ContactGeometry::curvatureSpread, bend, ellipse);
    // the gap grows by r^2 / 2 R0: of a half-space dF/dk = -dF/dd a^2 / 3
    const double a = response.contactRadius;
    slopes.curvature = -response.stiffness * a * a / 3.0 * local.depth / power +
      energy * relativeSlope(local, &ContactGeometry::surfaceCurvature, bend, ellipse);
  }
  if (law.settings().thickness && std::isfinite(local.thickness))
  {
    const double thicker = kChange * local.thickness;
    const auto layer = [&](const ContactGeometry& at) { return law.layerThickness(at); };
    const auto force = [&](const ContactGeometry& at)
    { return at.thickness == local.thickness ? response.force : law(at).force; };
    const double byThickness = response.force * local.depth / (power + 0.5) *
      relativeSlope(local, &ContactGeometry::thickness, thicker, force);
    slopes.thickness = byThickness;
    const double layerByThickness =
      relativeSlope(local, &ContactGeometry::thickness, thicker, layer);
    slopes.curvature += byThickness / layerByThickness *
      relativeSlope(local, &ContactGeometry::surfaceCurvature, bend, layer);
  }
  return slopes;
}

} // namespace palp
