#include "haptics/contact/overlap/immersion.h"

#include "haptics/contact/overlap/section.h"
#include "haptics/numerics/leveled.h"
#include "haptics/numerics/smooth_step.h"

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
constexpr double kFlat = 0.05;    // [-] sine of a lean over which the rim comes to be its lowest
constexpr double kLevel = 0.02;   // [-] sine of a lean by which a flat lies flat,
constexpr double kLeaning = 0.1;  // [-] and from which it stands on its rim
constexpr int kSteps = 40;        // of Newton's method; three are usual
constexpr double kClose = 1e-12;  // [m]

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

// The normal as a flat end meets it, and how that turns with it.
struct Lean
{
  Eigen::Vector3d normal;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

Lean leanOf(const ToolSolid& solid, const Eigen::Vector3d& normal) noexcept
{
  const double lean = normal.head<2>().norm();
  if (!(solid.flatRadius() > 0.0) || lean >= kLeaning)
  {
    return { normal };
  }
  const double entered = std::max(0.0, (lean - kLevel) / (kLeaning - kLevel));
  const double part = smoothStep(entered);
  const double slope = 6.0 * entered * (1.0 - entered) / (kLeaning - kLevel);
  Lean less{ .normal = { part * normal.x(), part * normal.y(), 0.0 } };
  less.normal.z() = std::sqrt(1.0 - less.normal.squaredNorm());
  less.turn.setZero();
  const Eigen::Vector2d along = normal.head<2>() / std::max(lean, kLeast);
  less.turn.topLeftCorner<2, 2>() =
    part * Eigen::Matrix2d::Identity() + lean * slope * along * along.transpose();
  less.turn.bottomRows<1>() =
    -(less.normal.head<2>().transpose() * less.turn.topRows<2>()) / less.normal.z();
  return less;
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

// A flat that lies flat below the top of a round body, which does not cover it: a cap.
bool isCap(const ToolSolid& solid, const Lean& lean, double volume, const Leveled& bent) noexcept
{
  const double square = solid.flatRadius() * solid.flatRadius();
  return square > 0.0 && lean.normal.z() == 1.0 &&
    volume < 0.25 * kPi * bent.value * square * square;
}

} // namespace

Immersion immersionOf(const ToolSolid& solid, const Eigen::Vector3d& normal, double volume,
  double start, double curvature) noexcept
{
  const Lean lean = leanOf(solid, normal);
  if (const Leveled bent = leveled(curvature, widthAt(solid, 0.0).value);
      isCap(solid, lean, volume, bent))
  {
    const double depth = std::sqrt(bent.value * volume / kPi);
    return { .depth = depth,
      .byVolume = 0.5 * depth / volume,
      .byCurvature = 0.5 * depth / bent.value * bent.slope,
      .area = 2.0 * volume / depth };
  }
  double low = lowestOf(solid, lean.normal) - kLeast;
  double high = solid.top();
  double height = std::clamp(start, low, high);
  Taken taken{};
  for (int i = 0; i < kSteps; ++i)
  {
    taken = takenAt(solid, lean.normal, height, curvature);
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
  const double tall = std::hypot(lean.normal.head<2>().norm(), kFlat);
  const Eigen::Vector3d lower(lean.normal.x() / tall, lean.normal.y() / tall, 0.0);
  return { .depth = height + round * section.area,
    .byVolume = rising / taken.byHeight,
    .byCurvature =
      taken.bent.slope * (0.5 * section.area / kPi - rising * taken.cap / taken.byHeight),
    .byNormal =
      lean.turn.transpose() * (rising / taken.byHeight * turned - round * section.growing),
    .rim = solid.flatRadius() * (tall - kFlat),
    .rimByNormal = solid.flatRadius() * lean.turn.transpose() * lower,
    .area = section.area,
    .aside = section.moment / section.area };
}

} // namespace palp
