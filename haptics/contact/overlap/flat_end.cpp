#include "haptics/contact/overlap/flat_end.h"

#include "haptics/numerics/leveled.h"
#include "haptics/numerics/roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kLiftingLeast = 0.2; // [-] of height x area, least slope of the lift
constexpr double kRisePerArea = 0.5 / std::numbers::pi; // of a paraboloid, by its curvature

// The lift of a body whose rim is at a height: of a level plane, and of the paraboloid on it.
struct Lifted
{
  double area;        // [m^2]
  Leveled bent;       // [1/m]
  double top;         // of the paraboloid, over the rim [m]
  double topByHeight; // [-]
  double lift;        // [m^4]
  double byHeight;    // [m^3]
  double byBent;      // [m^5]
};

Lifted liftedAt(const ToolSolid& solid, double height, double curvature) noexcept
{
  const ToolSolid::Layer& layer = solid.layerAt(height);
  const double radius = layer.radiusAt(height);
  const double area = ToolSolid::crossArea(radius);
  const double growth = 2.0 * area * layer.slope / radius;
  const Sloped width = solid.radiusAt(height);
  const Leveled bent =
    curvature > 0.0 ? Leveled{ curvature, 1.0, 0.0 } : leveled(curvature, width.value);
  const double bentByHeight = bent.bySize * width.slope;
  const double top = kRisePerArea * bent.value * area;
  const double topByHeight = kRisePerArea * (bentByHeight * area + bent.value * growth);
  // over the area the paraboloid is top / 2 high in the mean, and top^2 / 3 in that of squares
  Lifted all{ area, bent, top, topByHeight,
    area * (layer.upward(layer.lift, height) + top * (0.5 * height + top / 6.0)),
    height * area + 0.5 * top * (area + height * growth) + top * top / 6.0 * growth +
      topByHeight * area * (0.5 * height + top / 3.0),
    kRisePerArea * area * area * (0.5 * height + top / 3.0) };
  const double hollow = -height - top; // what of a bowl is below the flat does not count
  if (hollow > 0.0)
  {
    const double cap = std::numbers::pi * hollow * hollow / std::abs(bent.value);
    const double rounder = hollow / (3.0 * std::abs(bent.value));
    all.lift -= cap * hollow / 3.0;
    all.byHeight += cap * (1.0 + topByHeight - rounder * bentByHeight);
    all.byBent += cap * (kRisePerArea * area - rounder);
  }
  else
  {
    all.byHeight = std::max(kLiftingLeast * height * area, all.byHeight);
  }
  return all;
}

} // namespace

Immersion flatImmersionOf(const ToolSolid& solid, double lift, double curvature) noexcept
{
  if (curvature > 0.0 && lift <= liftedAt(solid, 0.0, curvature).lift)
  {
    const double depth =
      std::cbrt(3.0 / std::numbers::pi * curvature * lift); // of a cap, within the flat
    return { .depth = depth,
      .byLift = depth / (3.0 * lift),
      .byCurvature = depth / (3.0 * curvature),
      .area = depth / (kRisePerArea * curvature) };
  }
  const double flat = ToolSolid::crossArea(solid.layers().front().radius);
  Lifted all{};
  const auto excess = [&](double height)
  {
    all = liftedAt(solid, height, curvature);
    return std::array{ all.lift - lift, all.byHeight };
  };
  const double start = std::min(std::sqrt(2.0 * lift / flat), solid.top());
  const double height = boundedNewton(start, { 0.0, solid.top() }, Immersion::kClose, excess);
  const double byLift = (1.0 + all.topByHeight) / all.byHeight;
  return { .depth = height + all.top,
    .byLift = byLift,
    .byCurvature = all.bent.slope * (kRisePerArea * all.area - byLift * all.byBent),
    .area = all.area };
}

} // namespace palp
