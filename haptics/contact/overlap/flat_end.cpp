#include "haptics/contact/overlap/flat_end.h"

#include "haptics/numerics/leveled.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kMostLean = 0.05;   // [-] cosine to the axis: no body leans more
constexpr double kLeastMean = 1e-12; // [-] of the mean depth by the lean: less is all rounding
constexpr int kTries = 60;

// The lift of a level plane by that of a leaning one of the same volume.
struct Leveling
{
  double part;      // [-]
  double byVolume;  // [1/m^3]
  double byTangent; // of the lean [-]
};

// The part of a disc of radius 1 beyond a line, by integrals over it of 1, of the distance to the
// line and of its square, all by pi.
struct Segment
{
  double area;
  double first;
  double second;
};

Segment beyond(double line) noexcept
{
  const double half = std::sqrt(std::max(0.0, 1.0 - line * line));
  const double angle = std::acos(std::clamp(line, -1.0, 1.0));
  const double area = angle - line * half;
  const double first = 2.0 / 3.0 * half * half * half;
  const double second = 0.25 * (angle + line * half * (1.0 - 2.0 * line * line));
  return { area / kHalfTurn, (first - line * area) / kHalfTurn,
    (second - 2.0 * line * first + line * line * area) / kHalfTurn };
}

// where the plane meets the flat, by the mean depth over the lean; below 1
Segment segmentOf(double mean) noexcept
{
  double low = -1.0;
  double high = 1.0;
  double line = 1.0 - 2.0 * std::pow(mean, 0.4);
  Segment segment = beyond(line);
  for (int i = 0; i < kTries && std::abs(segment.first - mean) > 1e-15 * mean; ++i)
  {
    (segment.first > mean ? low : high) = line;
    line += (segment.first - mean) / std::max(segment.area, 1e-300);
    if (!(line > low && line < high))
    {
      line = 0.5 * (low + high);
    }
    segment = beyond(line);
  }
  return segment;
}

Leveling levelingOf(double radius, double volume, double tangent) noexcept
{
  const double area = kHalfTurn * radius * radius;
  const double leaning = area * radius * tangent;
  if (volume >= leaning)
  {
    const double squares = 4.0 * volume * volume + leaning * leaning;
    const double part = 4.0 * volume * volume / squares;
    const double fall = 2.0 * (1.0 - part) * part;
    return { part, fall / volume, tangent > 0.0 ? -fall / tangent : 0.0 };
  }
  const double mean = std::max(kLeastMean, volume / leaning);
  const Segment segment = segmentOf(mean);
  const double part = segment.first * segment.first / segment.second;
  const double rise = 2.0 * segment.first * (1.0 - part / segment.area) / segment.second;
  return { part, rise * mean / volume, -rise * mean / tangent };
}

// of a level flat in a paraboloid
struct Sunk
{
  double depth;       // of the middle [m]
  double byLift;      // [1/m^3]
  double byCurvature; // [m^2]
  double area;        // of the body's surface below the flat [m^2]
};

Sunk sunkIn(double radius, double lift, double curvature) noexcept
{
  const double square = radius * radius;
  const double area = kHalfTurn * square;
  const double top = curvature * square;    // twice what the body rises over the rim
  const double variance = top * top / 48.0; // of that rise
  const double squared = 2.0 * lift / area; // depth, in the mean
  if (squared > 4.0 * variance)
  {
    const double root = std::sqrt(squared - variance);
    return { 0.25 * top + root, 1.0 / (area * root), square * (0.25 - top / (48.0 * root)), area };
  }
  // a cap, or in a hollow a ring, which is deepest at the rim
  const double deepest = std::cbrt(3.0 * std::abs(curvature) * lift / kHalfTurn);
  const bool isRing = curvature < 0.0;
  return { deepest + (isRing ? 0.5 * top : 0.0), deepest / (3.0 * lift),
    deepest / (3.0 * curvature) + (isRing ? 0.5 * square : 0.0),
    2.0 * kHalfTurn * deepest / std::abs(curvature) };
}

} // namespace

Immersion flatImmersionOf(
  double radius, const Eigen::Vector3d& outward, const Pressed& pressed, double curvature) noexcept
{
  const double across = outward.head<2>().norm();
  const double along = std::max(kMostLean, outward.z());
  const Leveling level = levelingOf(radius, pressed.volume, across / along);
  const Leveled bent =
    curvature > 0.0 ? Leveled{ curvature, 1.0, 0.0 } : leveled(curvature, radius);
  const Sunk sunk = sunkIn(radius, level.part * pressed.lift, bent.value);
  const double byPart = sunk.byLift * pressed.lift;
  Immersion result{ .depth = sunk.depth,
    .byVolume = byPart * level.byVolume,
    .byLift = sunk.byLift * level.part,
    .byCurvature = bent.slope * sunk.byCurvature,
    .area = sunk.area };
  if (across > 0.0)
  {
    Eigen::Vector3d turning = Eigen::Vector3d::Zero(); // of the tangent
    turning.head<2>() = outward.head<2>() / (across * along);
    turning.z() = outward.z() > kMostLean ? -across / (along * along) : 0.0;
    result.byNormal = byPart * level.byTangent * turning;
  }
  return result;
}

} // namespace palp
