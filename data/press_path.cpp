#include "data/press_path.h"

#include "data/implicit.h"
#include "data/liver.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kToolRadius = 10.0_mm;
constexpr double kClearance = 5.0_mm;
constexpr double kDepth = 8.0_mm;
constexpr double kSlide = 12.0_mm;

// moments of the motion [s]
constexpr double kPressed = 1.5;
constexpr double kSlideStart = 2.0;
constexpr double kSlideEnd = 3.0;
constexpr double kLift = 3.2;
constexpr double kEnd = 4.0;
constexpr double kInterval = 0.02; // between rows

// 0 to 1 as a hand moves, with the least jerk; Flash and Hogan, 1985
double reach(double from, double to, double time) noexcept
{
  const double t = std::clamp((time - from) / (to - from), 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

} // namespace

std::vector<PathKnot> liverPressPath()
{
  // the front of the right lobe, a hand's breadth from the midline
  const Vector3d start = ontoSurface(liverDistance, { -45.0_mm, -45.0_mm, 5.0_mm });
  const Vector3d axis = -levelNormal(liverDistance, start);
  const Vector3d along = (Vector3d::UnitX() - Vector3d::UnitX().dot(axis) * axis).normalized();

  std::vector<PathKnot> knots;
  const int last = static_cast<int>(std::lround(kEnd / kInterval));
  for (int i = 0; i <= last; ++i)
  {
    const double time = i * kInterval;
    const double pressed = reach(0.0, kPressed, time) - reach(kLift, kEnd, time);
    const double depth = (kDepth + kClearance) * pressed - kClearance;
    const Vector3d foot =
      ontoSurface(liverDistance, start + kSlide * reach(kSlideStart, kSlideEnd, time) * along);
    const Vector3d center = foot + (kToolRadius - depth) * levelNormal(liverDistance, foot);
    knots.push_back({ .time = time, .apex = center + kToolRadius * axis, .axis = axis });
  }
  return knots;
}

} // namespace palp
