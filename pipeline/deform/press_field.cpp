#include "pipeline/deform/press_field.h"

#include "haptics/numerics/smooth_step.h"
#include "pipeline/deform/tool_gap.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kDeepest = 0.99;     // [-] of the depth: sink where a contact ends
constexpr double kFitReach = 1.5;     // [-] of the contact radius
constexpr double kPressedOn = 0.8;    // [-] of the contact radius
constexpr double kSteeper = 2.0;      // [-] of the fitted slope against the contact radius
constexpr double kFallen = 0.2;       // [-] of the outer control value: a sink that is none
constexpr double kLeastFallen = 0.05; // [-] of the sink at the contact, the same
constexpr double kTinyRadius = 1e-12; // [m]
constexpr double kFilledPit = 0.1;    // [-] of the contact radius: pressed onto the tool
constexpr double kOpenPit = 0.4;      // [-] of the contact radius: not reached by the tool

} // namespace

void PressField::lay(const PressRegion& region, const ToolBody& body, double depth,
  const std::optional<SurfaceProfile>& fitted, bool isLiteral)
{
  fittedCurve_ = fitted;
  isLiteral_ = isLiteral;
  normal_ = region.normal();
  deepest_ = depth;
  reach_ = 0.0;
  surface_.fit(region, kFitReach * std::max(region.inner(), 2.0 * region.edgeLength()));
  for (int k = 0; k < kDirections; ++k)
  {
    curves_[static_cast<std::size_t>(k)] =
      curveAlong(directionOf(4.0 * k / kDirections), region, body);
  }
  curves_.back() = curves_.front();
  for (int k = 0; k < kDirections; ++k)
  {
    // a straight line between two directions' sinks would leave a step at the contact circle
    const double turns = 4.0 * (k + 0.5) / kDirections;
    const RingCurve& a = curves_[static_cast<std::size_t>(k)];
    const RingCurve& b = curves_[static_cast<std::size_t>(k) + 1];
    if (!(a.sink > 0.0 && b.sink > 0.0))
    {
      bulges_[static_cast<std::size_t>(k)] = 0.0;
      continue;
    }
    const ToolGap gap(surface_, region, body, directionOf(turns));
    double height = gap(0.5 * (a.inner + b.inner));
    if (!std::isfinite(height))
    {
      height = gap(gap.exit(gap(0.0))); // past the rim, which is a circle
    }
    bulges_[static_cast<std::size_t>(k)] = 4.0 * (std::max(0.0, -height) - 0.5 * (a.sink + b.sink));
  }
}

// P0, P1 and P2 of Fig. 5(b) from the tool and the fitted surface
RingCurve PressField::curveAlong(
  const Eigen::Vector2d& towards, const PressRegion& region, const ToolBody& body) noexcept
{
  const ToolGap gap(surface_, region, body, towards);
  const double atCenter = gap(0.0);
  if (!(atCenter < 0.0))
  {
    return makeRingCurve(0.0, 0.0, 0.0, region.outer());
  }
  const double exit = gap.exit(atCenter);
  double end = std::min(region.inner(), isLiteral_ ? exit : gap.contactBefore(exit));
  if (fittedCurve_ && !body.hasFlatBase())
  {
    // as deep as on a plane, like the contact of two spheres, however the surface is bent and the
    // tool leans: a radius that grows up a steep flank would come out of the surface there
    const double sink = atCenter * std::min(kDeepest, fittedCurve_->sink / deepest_);
    end = std::min(gap.contactBefore(exit), gap.radiusAt(sink, exit));
  }
  const double flat = gap.contactBefore(gap.flatEdge(exit));
  const double contact = std::max(std::min(region.inner(), flat), end);
  const double sink = -gap(contact);
  const double slope = gap.slopeAt(contact, exit);
  const RingCurve curve = makeRingCurve(contact, sink, slope, region.outer());
  if (follows(curve))
  {
    reach_ = std::max(reach_, fittedTo(curve).reach());
  }
  else if (slope > 0.0)
  {
    reach_ = std::max(reach_, ringRadiusFor(contact + sink / slope, region.inner()));
  }
  return curve;
}

inline RingCurve PressField::curveTowards(double turns) const noexcept
{
  constexpr int kQuarter = kDirections / 4;
  const double patch = turns * kQuarter;
  const int below = std::min(static_cast<int>(patch), kDirections - 1);
  const double v = patch - below;
  const RingCurve& a = curves_[static_cast<std::size_t>(below)];
  const RingCurve& b = curves_[static_cast<std::size_t>(below) + 1];
  const auto between = [v](double first, double second) { return first + v * (second - first); };
  const double bulge = v * (1.0 - v) * bulges_[static_cast<std::size_t>(below)];
  // beside a flat that leans the bulge alone would lift the surface
  const double sink = std::max(0.0, between(a.sink, b.sink) + bulge);
  return { between(a.inner, b.inner), sink, between(a.meet, b.meet), a.outer };
}

std::array<Eigen::Vector3d, 3> PressField::controlPoints(
  int direction, const PressRegion& region) const noexcept
{
  const RingCurve& curve = curves_[static_cast<std::size_t>(direction)];
  const Eigen::Vector2d towards = directionOf(4.0 * direction / kDirections);
  const auto point = [&](double radius, double sink)
  {
    const Eigen::Vector2d at = radius * towards;
    return region.toSurface({ at.x(), at.y(), surface_.height(at.x(), at.y()) - sink });
  };
  return { point(curve.inner, curve.sink), point(curve.meet, 0.0), point(curve.outer, 0.0) };
}

// the fitted shape between a direction's own ends; its control values suit the slope they were
// fitted with, and one that steepens as the tool sinks would lift what is around it
SurfaceProfile PressField::fittedTo(const RingCurve& curve) const noexcept
{
  SurfaceProfile profile = *fittedCurve_;
  const double scale = curve.sink / profile.sink;
  const double wider = curve.inner / profile.inner;
  const double steepest = kSteeper * scale * profile.slope / wider;
  profile.inner = curve.inner;
  profile.sink = curve.sink;
  profile.slope = std::min(steepest, curve.sink / (curve.meet - curve.inner));
  profile.control = { scale * profile.control[0], scale * profile.control[1] };
  // so that it ends where it does elsewhere, but not on a contact that is much wider: there as a
  // part of what the curve falls to, with which it goes on sinking as the contact ends at a rim
  const double most = std::max(kFallen * profile.control[0], kLeastFallen * curve.sink);
  profile.rest = std::min(profile.rest * scale * wider * wider, most);
  return profile;
}

// of the smooth surface: what the paper gives every way from the contact
inline double PressField::smoothSink(double distance, const RingCurve& curve) const noexcept
{
  // no deeper than the tool, which on a rough surface is deeper at the circle than the contact says
  const double deepest = std::max(deepest_, curve.sink);
  return std::min(
    follows(curve) ? fittedTo(curve).sinkAt(distance) : curve.sinkAt(distance), deepest);
}

// of the fitted surface above a place that lies lower by so much, as far as it goes along: on the
// tool, and no farther beside it than the contact is wide
double PressField::sinkAbove(const GeodesicCoordinates& geodesic, double below,
  const Eigen::Vector3d& rest, const ToolBody& body) const noexcept
{
  const double radius = geodesic.local.head<2>().norm();
  const RingCurve curve = curveTowards(diamondAngle(geodesic.local.x(), geodesic.local.y()));
  if (radius > curve.inner)
  {
    return (1.0 - smoothStep(radius / curve.inner - 1.0)) * smoothSink(radius, curve);
  }
  const double toTool = body.lowest(rest, normal_);
  const double onTool = std::isfinite(toTool) ? below - toTool : curve.sink;
  return std::min(onTool, std::max(deepest_, curve.sink));
}

// a side goes down with the surface above it, less and less with its own depth, so that it is
// compressed and does not fold
[[gnu::noinline]] double PressField::sideSink(const GeodesicCoordinates& geodesic,
  const Eigen::Vector3d& rest, const RingCurve& curve, const ToolBody& body) const noexcept
{
  const double below = std::max(0.0, -heightOverFit(geodesic));
  const double above = sinkAbove(geodesic, below, rest, body);
  const double traveled = std::min(1.0, geodesic.distance / curve.outer);
  const double left =
    std::max(0.0, 1.0 - below / curve.outer) * (1.0 - traveled * traveled * traveled * traveled);
  return std::max(smoothSink(geodesic.distance, curve), above * left);
}

// on the tool within the contact; around it what the fit leaves of the surface goes with it, less
// and less so to where the fit ends; a pit that the tool does not reach goes down as a side does
inline double PressField::frontSink(const GeodesicCoordinates& geodesic,
  const Eigen::Vector3d& rest, const RingCurve& curve, const ToolBody& body) const noexcept
{
  const double left = heightOverFit(geodesic);
  double sink = 0.0;
  double fade = 1.0;
  if (geodesic.distance <= curve.inner)
  {
    // what lies lower than the fit comes onto the tool within the contact, not before it
    const double within = 1.0 - geodesic.distance / std::max(curve.inner, kTinyRadius);
    const double open = std::max(0.0, -left) * (1.0 - smoothStep(within / kPressedOn));
    const double toTool = body.lowest(rest, normal_);
    // past the tool's rim by a hair as the ring begins
    sink = std::isfinite(toTool) ? std::max(0.0, open - toTool) : curve.sink + std::max(0.0, left);
  }
  else
  {
    sink = smoothSink(geodesic.distance, curve);
    const double end = std::min(surface_.reach(), curve.outer);
    if (!(geodesic.distance < end))
    {
      return sink;
    }
    fade = 1.0 - smoothStep((geodesic.distance - curve.inner) / (end - curve.inner));
    sink += fade * std::max(0.0, left);
  }
  if (-left > kFilledPit * curve.inner)
  {
    const double pit = smoothStep((-left / curve.inner - kFilledPit) / (kOpenPit - kFilledPit));
    sink += fade * pit * std::max(0.0, sideSink(geodesic, rest, curve, body) - sink);
  }
  return sink;
}

PressField::Sink PressField::sinkAt(const GeodesicCoordinates& geodesic,
  const Eigen::Vector3d& rest, const ToolBody& body) const noexcept
{
  const RingCurve curve = curveTowards(geodesic.turns);
  const double sink = geodesic.isFront() ? frontSink(geodesic, rest, curve, body)
                                         : sideSink(geodesic, rest, curve, body);
  const bool isUnder = geodesic.isFront() && geodesic.distance <= curve.inner && sink > 0.0;
  return isUnder ? Sink{ sink, Zone::Contact } : keptOutside({ sink, Zone::Ring }, rest, body);
}

PressField::Sink PressField::keptOutside(
  const Sink& sink, const Eigen::Vector3d& rest, const ToolBody& body) const noexcept
{
  const Eigen::Vector3d sunk = rest - sink.depth * normal_;
  if (body.contains(sunk))
  {
    // infinite where the tool points along the surface or away from it
    if (const double up = body.lowest(sunk, normal_); std::isfinite(up))
    {
      return { sink.depth - up, Zone::Contact };
    }
  }
  return sink;
}

} // namespace palp
