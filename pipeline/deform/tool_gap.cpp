#include "pipeline/deform/tool_gap.h"

#include "haptics/numerics/roots.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

constexpr double kStillOnTool = 0.9;       // [-] of the radius where the tool leaves the surface
constexpr double kWithinBase = 1.0 - 1e-7; // [-]
constexpr double kRim = 1.0 - 1e-6;        // [-] of the base: as far as contact goes
constexpr double kLeast = 1e-4;            // [-] of the radius: width of the ring's first piece
constexpr double kSlopeStep = 1e-3;        // [-] of the contact radius
constexpr int kHalvings = 30;

// root of a function that is negative at 0 and positive at the end
template <typename Function>
double rootBefore(double end, double atZero, double atEnd, Function function) noexcept
{
  const auto limited = [&](double at) noexcept { return std::min(function(at), end); };
  return falsePosition(limited, { 0.0, end }, atZero, std::min(atEnd, end), 1e-6 * end, 40).low;
}

} // namespace

ToolGap::ToolGap(const LocalQuadric& surface, const PressRegion& region, const ToolBody& body,
  const Eigen::Vector2d& towards) noexcept
  : surface_(surface)
  , body_(body)
  , towards_(towards)
  , normal_(region.normal())
  , center_(region.toSurface(Eigen::Vector3d::Zero()))
  , outwards_(region.toSurface({ towards.x(), towards.y(), 0.0 }) - center_)
  , onTip_(fromAxis(0.0) < kWithinBase * body.base())
{
}

double ToolGap::fromAxis(double radius) const noexcept
{
  return body_.fromAxis(foot(radius) + body_.lowest(foot(radius), normal_) * normal_);
}

double ToolGap::operator()(double radius) const noexcept
{
  const double up = body_.lowest(foot(radius), normal_);
  const bool isShaft =
    onTip_ && !(body_.fromAxis(foot(radius) + up * normal_) < kWithinBase * body_.base());
  return isShaft ? std::numeric_limits<double>::infinity()
                 : up - surface_.height(radius * towards_.x(), radius * towards_.y());
}

double ToolGap::exit(double atCenter) const noexcept
{
  // of a tool that leans the rim is farther away on the side where its flank lies low
  const double end = kRim * std::max(body_.base(), body_.rim(center_, outwards_, normal_));
  const double atEnd = (*this)(end);
  return atEnd > 0.0 ? rootBefore(end, atCenter, atEnd, *this) : end;
}

double ToolGap::contactBefore(double edge) const noexcept
{
  const double height = (*this)(edge);
  const double rise = height - (*this)(kStillOnTool * edge);
  const double further = -height * (1.0 - kStillOnTool) / rise; // [-] of the edge
  return rise > 0.0 ? std::min(1.0, kStillOnTool * (1.0 + further)) * edge : edge;
}

double ToolGap::flatEdge(double end) const noexcept
{
  if (!(body_.flat() > 0.0) || body_.hasFlatBase())
  {
    return 0.0;
  }
  const auto isFlat = [this](double radius) { return fromAxis(radius) < body_.flat(); };
  return bisect(isFlat, { 0.0, end }, kHalvings).low;
}

double ToolGap::radiusAt(double height, double end) const noexcept
{
  const auto isDeeper = [&](double radius) { return (*this)(radius) < height; };
  return bisect(isDeeper, { 0.0, end }, kHalvings).high;
}

double ToolGap::slopeAt(double contact, double exit) const noexcept
{
  if (body_.hasCorners() || body_.hasFlatBase())
  {
    // to the exit, which goes outwards with the depth: a tangent that turns at a corner would draw
    // back. A flat base leaves the surface in its shaft.
    const double from = std::min(contact, (1.0 - kLeast) * exit);
    const double atExit = body_.hasFlatBase() ? 0.0 : (*this)(exit);
    return (atExit - (*this)(from)) / (exit - from);
  }
  const double step = kSlopeStep * contact;
  const double height = (*this)(contact);
  const double before = height - (*this)(contact - step);
  const double after = (*this)(contact + step) - height;
  // at the rim the flank goes on
  return (std::isfinite(after) ? 0.5 * (before + after) : before) / step;
}

} // namespace palp
