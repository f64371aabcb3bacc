#include "pipeline/press_field.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kStillOnTool = 0.9;       // [-] of the radius where the tool leaves the surface
constexpr double kWithinBase = 1.0 - 1e-9; // [-]
constexpr double kVertical = 1e6;          // [-] slope of a shaft
constexpr double kFitReach = 1.5;          // [-] of the contact radius

// root of a function that is negative at 0 and positive at the end, by the Illinois rule
template <typename Function>
double rootBefore(double end, double atZero, double atEnd, Function function) noexcept
{
  double low = 0.0;
  double high = end;
  double atLow = atZero;
  double atHigh = std::min(atEnd, end);
  for (int i = 0; i < 12 && high - low > 1e-6 * end; ++i)
  {
    const double middle = low + (high - low) * atLow / (atLow - atHigh);
    const double value = std::min(function(middle), end);
    if (value < 0.0)
    {
      low = middle;
      atLow = value;
      atHigh *= 0.5;
    }
    else
    {
      high = middle;
      atHigh = value;
      atLow *= 0.5;
    }
  }
  return low;
}

} // namespace

void PressField::lay(const PressRegion& region, const ToolBody& body, double depth,
  const std::optional<SurfaceProfile>& fitted)
{
  fittedCurve_ = fitted;
  normal_ = region.normal();
  deepest_ = depth;
  reach_ = 0.0;
  fitSurface(region);
  for (int k = 0; k < kDirections; ++k)
  {
    curves_[static_cast<std::size_t>(k)] =
      curveAlong(directionOf(4.0 * k / kDirections), region, body);
  }
  curves_.back() = curves_.front();
}

// least squares over the points around the contact, weighted so that none enters with a jump
void PressField::fitSurface(const PressRegion& region)
{
  const double reach = kFitReach * std::max(region.inner(), 2.0 * region.edgeLength());
  const double scale = 1.0 / reach;
  fitted_ = reach;
  Eigen::Matrix<double, 6, 6> sums;
  Quadric heights = Quadric::Zero();
  // the sums of w x^i y^j, of which the normal equations have each several times
  std::array<double, 15> moments{};
  for (const Place& place : region.places())
  {
    const double x = scale * place.local.x();
    const double y = scale * place.local.y();
    const double left = 1.0 - x * x - y * y;
    if (!(left > 0.0) || !place.front)
    {
      continue;
    }
    const double xx = x * x;
    const double xy = x * y;
    const double yy = y * y;
    const std::array<double, 15> terms{ 1.0, x, y, xx, xy, yy, xx * x, xx * y, yy * x, yy * y,
      xx * xx, xx * xy, xx * yy, xy * yy, yy * yy };
    for (std::size_t i = 0; i < moments.size(); ++i)
    {
      moments[i] += left * left * terms[i];
    }
    for (std::size_t i = 0; i < 6; ++i)
    {
      heights[static_cast<Eigen::Index>(i)] += left * left * place.local.z() * terms[i];
    }
  }
  const auto& m = moments;
  sums << m[0], m[1], m[2], m[3], m[4], m[5], //
    m[1], m[3], m[4], m[6], m[7], m[8],       //
    m[2], m[4], m[5], m[7], m[8], m[9],       //
    m[3], m[6], m[7], m[10], m[11], m[12],    //
    m[4], m[7], m[8], m[11], m[12], m[13],    //
    m[5], m[8], m[9], m[12], m[13], m[14];
  // a trace of stiffness keeps at zero what few points leave open
  sums.diagonal().array() += 1e-6 * sums(0, 0) + 1e-12;
  Quadric units;
  units << 1.0, scale, scale, scale * scale, scale * scale, scale * scale;
  surface_ = sums.ldlt().solve(heights).cwiseProduct(units);
}

double PressField::surfaceHeight(double x, double y) const noexcept
{
  return surface_[0] + x * (surface_[1] + x * surface_[3] + y * surface_[4]) +
    y * (surface_[2] + y * surface_[5]);
}

// P0, P1 and P2 of Fig. 5(b) from the tool and the fitted surface
RingCurve PressField::curveAlong(
  const Eigen::Vector2d& towards, const PressRegion& region, const ToolBody& body) noexcept
{
  const Eigen::Vector3d outwards =
    region.toSurface({ towards.x(), towards.y(), 0.0 }) - region.toSurface(Eigen::Vector3d::Zero());
  const Eigen::Vector3d center = region.toSurface(Eigen::Vector3d::Zero());
  // how far the tool is above the undeformed surface, less than zero where it is pressed in
  const auto gap = [&](double radius)
  {
    return body.lowest(center + radius * outwards, normal_) -
      surfaceHeight(radius * towards.x(), radius * towards.y());
  };
  const double atCenter = gap(0.0);
  if (!(atCenter < 0.0))
  {
    return makeRingCurve(0.0, 0.0, kVertical, region.outer());
  }
  double end = region.inner() / kStillOnTool;
  double atEnd = gap(end);
  if (!std::isfinite(atEnd))
  {
    end = kWithinBase * region.inner(); // the tool ends in its shaft there, not above the surface
    atEnd = gap(end);
  }
  const double contact = atEnd > 0.0 ? kStillOnTool * rootBefore(end, atCenter, atEnd, gap)
                                     : std::min(region.inner(), end);
  const double step = 1e-3 * contact;
  const double height = gap(contact);
  const double before = height - gap(contact - step);
  const double after = gap(contact + step) - height;
  // at the rim of the base the flank goes on; a flat base ends in its shaft
  const double slope = std::isfinite(after) ? 0.5 * (before + after) / step
    : before > 1e-3 * step                  ? before / step
                                            : kVertical;
  if (slope > 0.0)
  {
    reach_ = std::max(reach_, contact - height / slope);
  }
  return makeRingCurve(contact, -height, slope, region.outer());
}

inline RingCurve PressField::curveTowards(double turns) const noexcept
{
  const double patch = turns * (kDirections / 4);
  const int below = std::min(static_cast<int>(patch), kDirections - 1);
  const double v = patch - below;
  const RingCurve& a = curves_[static_cast<std::size_t>(below)];
  const RingCurve& b = curves_[static_cast<std::size_t>(below) + 1];
  const auto between = [v](double first, double second) { return first + v * (second - first); };
  return { between(a.inner, b.inner), between(a.sink, b.sink), between(a.meet, b.meet), a.outer };
}

std::array<Eigen::Vector3d, 3> PressField::controlPoints(
  int direction, const PressRegion& region) const noexcept
{
  const RingCurve& curve = curves_[static_cast<std::size_t>(direction)];
  const Eigen::Vector2d towards = directionOf(4.0 * direction / kDirections);
  const auto point = [&](double radius, double sink)
  {
    const Eigen::Vector2d at = radius * towards;
    return region.toSurface({ at.x(), at.y(), surfaceHeight(at.x(), at.y()) - sink });
  };
  return { point(curve.inner, curve.sink), point(curve.meet, 0.0), point(curve.outer, 0.0) };
}

// the fitted shape between a direction's own ends
double PressField::fittedSink(const RingCurve& curve, double radius) const noexcept
{
  SurfaceProfile profile = *fittedCurve_;
  const double scale = curve.sink / profile.sink;
  profile.inner = curve.inner;
  profile.outer = curve.outer;
  profile.sink = curve.sink;
  profile.slope = curve.sink / (curve.meet - curve.inner);
  profile.control = { scale * profile.control[0], scale * profile.control[1] };
  return profile.sinkAt(radius);
}

inline double PressField::ringSink(const Place& place, const RingCurve& curve) const noexcept
{
  const bool isFitted = fittedCurve_ && curve.sink > 0.0 && curve.meet > curve.inner;
  const double sink =
    std::min(isFitted ? fittedSink(curve, place.distance) : curve.sinkAt(place.distance), deepest_);
  const double end = std::min(fitted_, curve.outer);
  if (!place.front || !(place.distance < end))
  {
    return sink;
  }
  // what the fit leaves of the surface goes with it at the contact circle, and less and less so to
  // where the fit ends
  const double t = (place.distance - curve.inner) / (end - curve.inner);
  const double fade = (1.0 - t) * (1.0 - t) * (1.0 + 2.0 * t);
  const double left = place.local.z() - surfaceHeight(place.local.x(), place.local.y());
  return sink + std::clamp(fade * left, -sink, sink);
}

// a side below the tool goes down with the surface above it, less and less with its own depth, so
// that it is compressed and does not fold
double PressField::sideSink(
  const Place& place, const RingCurve& curve, double toTool) const noexcept
{
  const double below =
    std::max(0.0, surfaceHeight(place.local.x(), place.local.y()) - place.local.z());
  const double above = std::isfinite(toTool) ? std::min(below - toTool, deepest_) : 0.0;
  return std::max(0.0, above * (1.0 - below / curve.outer));
}

PressField::Sink PressField::sinkAt(
  const Place& place, const Eigen::Vector3d& rest, const ToolBody& body) const noexcept
{
  const RingCurve curve = curveTowards(place.turns);
  if (place.front && place.distance <= curve.inner)
  {
    const double toTool = body.lowest(rest, normal_);
    const double sink = std::isfinite(toTool) ? std::max(0.0, -toTool) : curve.sink;
    return { sink, sink > 0.0 ? Zone::Contact : Zone::Ring };
  }
  double sink = ringSink(place, curve);
  if (!place.front)
  {
    sink = std::max(sink, sideSink(place, curve, body.lowest(rest, normal_)));
  }
  const Eigen::Vector3d sunk = rest - sink * normal_;
  if (body.contains(sunk))
  {
    return { sink - body.lowest(sunk, normal_), Zone::Contact };
  }
  return { sink, Zone::Ring };
}

} // namespace palp
