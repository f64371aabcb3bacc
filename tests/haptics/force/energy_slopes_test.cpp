#include "haptics/force/energy_slopes.h"

#include "haptics/numerics/quadrature.h"
#include "haptics/units.h"
#include "tests/haptics/force/tips.h"
#include "tests/support/shipped_ratios.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

double energyOf(const ForceLaw& law, ContactGeometry at)
{
  const Quadrature rule = gaussLegendre(24, 0.0, 1.0);
  const double depth = at.depth;
  double energy = 0.0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
  {
    at.depth = rule.nodes[i] * depth;
    energy += rule.weights[i] * depth * law(at).force;
  }
  return energy;
}

// of thin and thick places, level and round ones, also where a body is so round and thick that its
// shape counts as thickness
std::vector<ContactGeometry> places()
{
  std::vector<ContactGeometry> all;
  for (const double depth : { 0.3_mm, 1.5_mm, 4.0_mm })
  {
    for (const double thickness : { 12.0_mm, 25.0_mm, 60.0_mm })
    {
      for (const double curvature : { -10.0, 0.0, 8.0, 30.0 })
      {
        all.push_back({ .depth = depth,
          .tilt = 0.15,
          .thickness = thickness,
          .surfaceCurvature = curvature,
          .curvatureSpread = 5.0 });
      }
    }
  }
  return all;
}

TEST(EnergySlopes, AreThoseOfTheIntegralOfTheForce)
{
  for (const Tip& tip : test::allTips())
  {
    const ForceLaw law(tip, makeMaterial(50.0_kPa, 0.45),
      { .mode = LawMode::Corrected, .largeStrain = test::shippedRatios() });
    for (const ContactGeometry& place : places())
    {
      const EnergySlopes slopes = energySlopes(law, place);
      const double energy = energyOf(law, place);
      // where much of a layer is pressed in, slopes grow as higher powers of the depth
      const double error = place.depth > 0.15 * place.thickness ? 0.12 : 0.07;
      const auto expectSlope = [&](double slope, double ContactGeometry::*what, double size)
      {
        constexpr double kStep = 1e-4;
        ContactGeometry less = place;
        ContactGeometry more = place;
        less.*what -= kStep * size;
        more.*what += kStep * size;
        const double is = (energyOf(law, more) - energyOf(law, less)) / (2.0 * kStep * size);
        EXPECT_NEAR(slope, is, error * std::abs(is) + 1e-3 * energy / size)
          << "tool " << tip.index() << ", " << place.depth << " m into " << place.thickness
          << " m, " << place.surfaceCurvature << " 1/m";
      };
      expectSlope(slopes.curvature, &ContactGeometry::surfaceCurvature, 1.0 / baseRadius(tip));
      expectSlope(slopes.spread, &ContactGeometry::curvatureSpread, 1.0 / baseRadius(tip));
      expectSlope(slopes.thickness, &ContactGeometry::thickness, place.thickness);
      expectSlope(slopes.tilt, &ContactGeometry::tilt, 1.0);
    }
  }
}

} // namespace
} // namespace palp
