#include "haptics/contact/overlap/immersion.h"

#include "haptics/contact/overlap/section.h"
#include "haptics/numerics/leveled.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kPi = std::numbers::pi;
constexpr double kSteepest = 0.2; // [-] of the area, least slope of the volume over the height
constexpr double kLeast = 1e-9;   // [m] of a width
constexpr int kSteps = 40;        // of Newton's method; three are usual
constexpr double kClose = 1e-12;  // [m]

// How wide a section is, or how fast that grows, whichever is more; by the height.
Sloped widthAt(const ToolSolid& solid, double height) noexcept
{
  const double steepest = std::max(1.0, solid.layers().front().slope);
  const Sloped radius = solid.radiusAt(height);
  return { std::max(kLeast, steepest * radius.value), steepest * radius.slope };
}

// As the tool meets it: a flat touches a body that is rounder than it only about its top.
Leveled bentAt(const ToolSolid& solid, double curvature, const Sloped& width) noexcept
{
  return solid.flatRadius() > 0.0 && curvature > 0.0 ? Leveled{ curvature, 1.0, 0.0 }
                                                     : leveled(curvature, width.value);
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
  const Leveled bent = bentAt(solid, curvature, width);
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

// A flat below the top of a round body, which does not cover it: a cap.
bool isCap(const ToolSolid& solid, double volume, double curvature) noexcept
{
  const double square = solid.flatRadius() * solid.flatRadius();
  return volume < 0.25 * kPi * curvature * square * square;
}

} // namespace

Immersion immersionOf(const ToolSolid& solid, const Eigen::Vector3d& outward, double volume,
  double start, double curvature) noexcept
{
  const bool isFlat = solid.flatRadius() > 0.0;
  const Eigen::Vector3d normal = isFlat ? Eigen::Vector3d::UnitZ() : outward;
  if (isCap(solid, volume, curvature))
  {
    const double depth = std::sqrt(curvature * volume / kPi);
    return { .depth = depth,
      .byVolume = 0.5 * depth / volume,
      .byCurvature = 0.5 * depth / curvature,
      .area = 2.0 * volume / depth };
  }
  double low = lowestOf(solid, normal) - kLeast;
  double high = solid.top();
  double height = std::clamp(start, low, high);
  Taken taken{};
  for (int i = 0; i < kSteps; ++i)
  {
    taken = takenAt(solid, normal, height, curvature);
    const double last = height;
    (taken.volume > volume ? high : low) = last;
    height = last - (taken.volume - volume) / taken.byHeight;
    if (!(height >= low && height <= high))
    {
      height = 0.5 * (low + high);
    }
    if (std::abs(height - last) < kClose)
    {
      break;
    }
  }
  const Section& section = taken.section;
  const double round = 0.5 / kPi * taken.bent.value;
  const double rising = 1.0 + round * section.growth + 0.5 / kPi * taken.bentSlope * section.area;
  const Eigen::Vector3d turned = section.moment + round * section.area * section.growing;
  return { .depth = height + round * section.area,
    .byVolume = rising / taken.byHeight,
    .byCurvature =
      taken.bent.slope * (0.5 * section.area / kPi - rising * taken.cap / taken.byHeight),
    .byNormal = isFlat
      ? Eigen::Vector3d(Eigen::Vector3d::Zero())
      : Eigen::Vector3d(rising / taken.byHeight * turned - round * section.growing),
    .area = section.area,
    .aside = section.moment / section.area };
}

} // namespace palp
