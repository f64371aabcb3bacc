#include "haptics/contact/overlap/immersion.h"

#include "haptics/contact/overlap/section.h"
#include "haptics/numerics/leveled.h"
#include "haptics/numerics/roots.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kPi = std::numbers::pi;
constexpr double kSteepest = 0.2; // [-] of the area, least slope of the volume over the height
constexpr double kLeast = 1e-9;   // [m] of a width

// How wide a section is, or how fast that grows, whichever is more; by the height.
Sloped widthAt(const ToolSolid& solid, double height) noexcept
{
  const double steepest = std::max(1.0, solid.layers().front().slope);
  const Sloped radius = solid.radiusAt(height);
  return { std::max(kLeast, steepest * radius.value), steepest * radius.slope };
}

// The volume that a body takes whose rim is at a height.
struct Taken
{
  Section section;
  Leveled bent;
  double bentSlope; // of the leveled curvature over the height [1/m^2]
  double cap;       // of the paraboloid, by the curvature [m^4]
  double volume;    // [m^3]
  double byHeight;  // [m^2]
};

Taken takenAt(
  const ToolSolid& solid, const Eigen::Vector3d& normal, double height, double curvature) noexcept
{
  const Sloped width = widthAt(solid, height);
  const Section section = sectionOf(solid, normal, height);
  const Leveled bent = leveled(curvature, width.value);
  const double bentSlope = bent.bySize * width.slope;
  const double cap = 0.25 / kPi * section.area * section.area;
  const double byHeight =
    section.area + 0.5 / kPi * bent.value * section.area * section.growth + bentSlope * cap;
  return { section, bent, bentSlope, cap, section.volume + bent.value * cap,
    std::max(kSteepest * section.area, byHeight) };
}

// Height of the lowest place of a tool [m]; of a cone that leans by more than its flank, the rim.
double lowestOf(const ToolSolid& solid, const Eigen::Vector3d& normal) noexcept
{
  const double lean = normal.head<2>().norm() * ToolSolid::outerPart();
  double lowest = 0.0;
  for (const ToolSolid::Layer& layer : solid.layers())
  {
    lowest = std::min(lowest, normal.z() * layer.low - lean * layer.radius);
  }
  return lowest;
}

} // namespace

Immersion immersionOf(const ToolSolid& solid, const Eigen::Vector3d& normal, double volume,
  double start, double curvature) noexcept
{
  const RootBracket bracket{ lowestOf(solid, normal) - kLeast, solid.top() };
  Taken taken{};
  const auto excess = [&](double height)
  {
    taken = takenAt(solid, normal, height, curvature);
    return std::array{ taken.volume - volume, taken.byHeight };
  };
  const double height =
    boundedNewton(std::clamp(start, bracket.low, bracket.high), bracket, Immersion::kClose, excess);
  const Section& section = taken.section;
  const double round = 0.5 / kPi * taken.bent.value;
  const double rising = 1.0 + round * section.growth + 0.5 / kPi * taken.bentSlope * section.area;
  const Eigen::Vector3d turned = section.moment + round * section.area * section.growing;
  return { .depth = height + round * section.area,
    .byVolume = rising / taken.byHeight,
    .byCurvature =
      taken.bent.slope * (0.5 * section.area / kPi - rising * taken.cap / taken.byHeight),
    .byNormal = rising / taken.byHeight * turned - round * section.growing,
    .area = section.area,
    .aside = section.moment / section.area };
}

} // namespace palp
