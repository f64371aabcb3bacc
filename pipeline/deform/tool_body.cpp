#include "pipeline/deform/tool_body.h"

#include "haptics/units.h"

#include <limits>
#include <type_traits>
#include <variant>

namespace palp
{
namespace
{

constexpr double kMiss = std::numeric_limits<double>::infinity();
constexpr double kParallel = 1e-9;   // [-] sine of the angle between line and axis
constexpr double kTolerance = 1e-10; // [m]
constexpr int kIterations = 40;

using namespace units::literals;

constexpr double kBetween = 12.0_deg; // normal and flank, at least
constexpr double kOuter = 1.0 - 1e-6; // [-] of the base

// how far the way down may lean from the axis: of a round tip its shaft is the first that can stand
// along it, of a profile its rim, of a punch its flat lies at the other side of that
double mostLean(const Tip& tip)
{
  return std::visit(
    [&tip](const auto& shape)
    {
      if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, ProfileTip>)
      {
        const double steepest = tipSlope(tip, kOuter * baseRadius(tip));
        return std::max(0.0, std::atan2(1.0, steepest) - kBetween);
      }
      if constexpr (requires { shape.halfAngle; })
      {
        return std::max(0.0, shape.halfAngle - kBetween);
      }
      return std::is_same_v<std::decay_t<decltype(shape)>, PunchTip> ? 45.0_deg
                                                                     : 90.0_deg - kBetween;
    },
    tip);
}

} // namespace

ToolBody::ToolBody(const Tip& tip, const ToolPose& pose)
  : tip_(tip)
  , apex_(pose.apex)
  , handle_(-pose.axis)
  , base_(baseRadius(tip))
  , flat_(flatRadius(tip))
  , sphere_(std::holds_alternative<SphereTip>(tip) ? std::get<SphereTip>(tip).radius : 0.0)
  , flank_(std::holds_alternative<ConeTip>(tip) ? tipSlope(tip, 0.0) : 0.0)
{
}

double ToolBody::inside(const Eigen::Vector3d& point) const noexcept
{
  const Eigen::Vector3d fromApex = point - apex_;
  const double height = fromApex.dot(handle_);
  const double radius = (fromApex - height * handle_).norm();
  return std::min(height - heightAt(radius), base_ - radius);
}

double ToolBody::lowest(const Eigen::Vector3d& origin, const Eigen::Vector3d& up) const noexcept
{
  const Eigen::Vector3d fromApex = origin - apex_;
  const double height = fromApex.dot(handle_);
  const double climb = up.dot(handle_);
  if (!(climb > kParallel))
  {
    return kMiss;
  }
  if (sphere_ > 0.0)
  {
    // the lower half of the sphere in closed form; the shaft is left to the march
    const Eigen::Vector3d fromCenter = fromApex - sphere_ * handle_;
    const double along = fromCenter.dot(up);
    const double square = along * along - fromCenter.squaredNorm() + sphere_ * sphere_;
    const double t = -along - std::sqrt(std::max(0.0, square));
    if (square >= 0.0 && height + t * climb <= sphere_)
    {
      return t;
    }
  }

  const Eigen::Vector3d radial = fromApex - height * handle_;
  const Eigen::Vector3d drift = up - climb * handle_;
  const double slant = drift.squaredNorm();
  double start = -height / climb; // nothing of the tool is below its apex
  if (slant < kParallel * kParallel)
  {
    const double radius = radial.norm();
    return radius < base_ ? start + heightAt(radius) / climb : kMiss;
  }
  const double along = radial.dot(drift) / slant;
  const double square = along * along - (radial.squaredNorm() - base_ * base_) / slant;
  if (square < 0.0)
  {
    return kMiss;
  }
  start = std::max(start, -along - std::sqrt(square)); // nor outside its shaft
  return march(start, height, climb, radial, drift);
}

double ToolBody::rim(const Eigen::Vector3d& origin, const Eigen::Vector3d& towards,
  const Eigen::Vector3d& up) const noexcept
{
  const double climb = up.dot(handle_);
  if (!(climb > kParallel))
  {
    return 0.0;
  }
  // up to the plane of the base, from its center
  const auto lifted = [&](const Eigen::Vector3d& from)
  { return Eigen::Vector3d(from - from.dot(handle_) / climb * up); };
  const Eigen::Vector3d start = lifted(origin - apex_ - heightAt(base_) * handle_);
  const Eigen::Vector3d drift = lifted(towards);
  const double slant = drift.squaredNorm();
  const double along = start.dot(drift) / slant;
  const double square = along * along - (start.squaredNorm() - base_ * base_) / slant;
  return square < 0.0 ? 0.0 : std::sqrt(square) - along;
}

// Newton's method on a function that is concave but for what a profile's cubics leave of that: it
// steps over the root by next to nothing, and then half its way back, so that the point is outside
double ToolBody::march(double start, double height, double climb, const Eigen::Vector3d& radial,
  const Eigen::Vector3d& drift) const noexcept
{
  double t = start;
  double outside = start;
  for (int i = 0; i < kIterations; ++i)
  {
    const Eigen::Vector3d across = radial + t * drift;
    const double radius = across.norm();
    const double widening = radius > 0.0 ? across.dot(drift) / radius : 0.0;
    const double overTip = height + t * climb - heightAt(radius);
    const double inShaft = base_ - radius;
    const double value = std::min(overTip, inShaft);
    if (value > kTolerance && t > outside)
    {
      t = 0.5 * (outside + t);
      continue;
    }
    if (value > -kTolerance)
    {
      return t;
    }
    const double growth =
      overTip <= inShaft ? climb - tipSlope(tip_, radius) * widening : -widening;
    if (!(growth > 0.0))
    {
      return kMiss;
    }
    outside = t;
    t -= value / growth;
  }
  return t;
}

Eigen::Vector3d drawnNormal(
  const Eigen::Vector3d& normal, const Eigen::Vector3d& axis, const Tip& tip)
{
  const double most = mostLean(tip);
  const double along = -normal.dot(axis);
  const Eigen::Vector3d across = normal + along * axis;
  const double length = across.norm();
  if (!(length > 0.0) || std::atan2(length, along) <= most)
  {
    return normal;
  }
  return std::sin(most) / length * across - std::cos(most) * axis;
}

} // namespace palp
