#include "pipeline/deform/press_field.h"

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
constexpr double kDeepest = 0.99;          // [-] of the depth: sink where a contact ends
constexpr int kHalvings = 30;
constexpr double kFitReach = 1.5;  // [-] of the contact radius
constexpr double kFilledPit = 0.1; // [-] of the contact radius: pressed onto the tool
constexpr double kOpenPit = 0.4;   // [-] of the contact radius: not reached by the tool

// 0 to 1 between 0 and 1, level at both ends
double smoothStep(double t) noexcept
{
  const double within = std::clamp(t, 0.0, 1.0);
  return within * within * (3.0 - 2.0 * within);
}

// root of a function that is negative at 0 and positive at the end
template <typename Function>
double rootBefore(double end, double atZero, double atEnd, Function function) noexcept
{
  const auto limited = [&](double at) noexcept { return std::min(function(at), end); };
  return falsePosition(limited, { 0.0, end }, atZero, std::min(atEnd, end), 1e-6 * end, 40).low;
}

// how far the tool is above the undeformed surface at a distance from the contact's center, less
// than zero where it is pressed in
class Gap
{
public:
  Gap(const LocalQuadric& surface, const PressRegion& region, const ToolBody& body,
    const Eigen::Vector2d& towards) noexcept
    : surface_(surface)
    , body_(body)
    , towards_(towards)
    , normal_(region.normal())
    , center_(region.toSurface(Eigen::Vector3d::Zero()))
    , outwards_(region.toSurface({ towards.x(), towards.y(), 0.0 }) - center_)
    , onTip_(isOnTip(center_ + body.lowest(center_, normal_) * normal_))
  {
  }

  // radius up to which the tool over the surface is as near to its axis as this, the end at most
  [[nodiscard]] double edgeOf(double fromAxis, double end) const noexcept
  {
    const auto isWithin = [&](double radius)
    {
      const Eigen::Vector3d foot = center_ + radius * outwards_;
      return body_.fromAxis(foot + body_.lowest(foot, normal_) * normal_) < fromAxis;
    };
    return bisect(isWithin, { 0.0, end }, kHalvings).low;
  }

  // infinite where a tool whose tip is below the center has its shaft, which leans over the
  // surface by next to nothing
  double operator()(double radius) const noexcept
  {
    const Eigen::Vector3d foot = center_ + radius * outwards_;
    const double up = body_.lowest(foot, normal_);
    return onTip_ && !isOnTip(foot + up * normal_)
      ? std::numeric_limits<double>::infinity()
      : up - surface_.height(radius * towards_.x(), radius * towards_.y());
  }

private:
  [[nodiscard]] bool isOnTip(const Eigen::Vector3d& point) const noexcept
  {
    return body_.fromAxis(point) < kWithinBase * body_.base();
  }

  const LocalQuadric& surface_;
  const ToolBody& body_;
  Eigen::Vector2d towards_;
  Eigen::Vector3d normal_;
  Eigen::Vector3d center_;
  Eigen::Vector3d outwards_;
  bool onTip_;
};

} // namespace

void PressField::lay(const PressRegion& region, const ToolBody& body, double depth,
  const std::optional<SurfaceProfile>& fitted)
{
  fittedCurve_ = fitted;
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
    const double exact =
      -Gap(surface_, region, body, directionOf(turns))(0.5 * (a.inner + b.inner));
    bulges_[static_cast<std::size_t>(k)] = a.sink > 0.0 && b.sink > 0.0 && std::isfinite(exact)
      ? 4.0 * (std::max(0.0, exact) - 0.5 * (a.sink + b.sink))
      : 0.0;
  }
}

// P0, P1 and P2 of Fig. 5(b) from the tool and the fitted surface
RingCurve PressField::curveAlong(
  const Eigen::Vector2d& towards, const PressRegion& region, const ToolBody& body) noexcept
{
  const Gap gap(surface_, region, body, towards);
  const double atCenter = gap(0.0);
  if (!(atCenter < 0.0))
  {
    return makeRingCurve(0.0, 0.0, 0.0, region.outer());
  }
  // where the tool leaves the surface, or its base ends below it
  double exit = std::min(region.inner() / kStillOnTool, kRim * body.base());
  double atExit = gap(exit);
  if (atExit > 0.0)
  {
    exit = rootBefore(exit, atCenter, atExit, gap);
    atExit = gap(exit);
  }
  // contact ends before the tool leaves the surface at an angle. An edge below the surface is
  // reached by and by: as if the tool went on as it rises to there, for no place may come up again
  const auto endBefore = [&](double edge)
  {
    const double height = gap(edge);
    const double rise = height - gap(kStillOnTool * edge);
    const double further = -height * (1.0 - kStillOnTool) / rise; // [-] of the edge
    return rise > 0.0 ? std::min(1.0, kStillOnTool * (1.0 + further)) * edge : edge;
  };
  const bool isCut = body.flat() > 0.0 && !body.hasFlatBase();
  const double flat = isCut ? endBefore(gap.edgeOf(body.flat(), exit)) : 0.0;
  double end = endBefore(exit);
  if (fittedCurve_ && !body.hasFlatBase())
  {
    // as deep as on a plane, like the contact of two spheres, however the surface is bent
    const double sink = atCenter * std::min(kDeepest, fittedCurve_->sink / deepest_);
    const auto isDeeper = [&](double radius) { return gap(radius) < sink; };
    end = std::min(end, bisect(isDeeper, { 0.0, exit }, kHalvings).high);
  }
  const double contact = std::min(region.inner(), std::max(flat, end));
  const double height = gap(contact);
  double slope = 0.0;
  if (body.hasCorners() || body.hasFlatBase())
  {
    // to where it leaves the surface, which goes outwards with the depth: a tangent that turns at a
    // corner would draw back. A flat base leaves it in its shaft.
    const double from = std::min(contact, (1.0 - kLeast) * exit);
    slope = ((body.hasFlatBase() ? 0.0 : atExit) - gap(from)) / (exit - from);
  }
  else
  {
    const double step = kSlopeStep * contact;
    const double before = height - gap(contact - step);
    const double after = gap(contact + step) - height;
    // at the rim the flank goes on
    slope = (std::isfinite(after) ? 0.5 * (before + after) : before) / step;
  }
  if (slope > 0.0)
  {
    reach_ = std::max(reach_, contact - height / slope);
  }
  return makeRingCurve(contact, -height, slope, region.outer());
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
  return { between(a.inner, b.inner), between(a.sink, b.sink) + bulge, between(a.meet, b.meet),
    a.outer };
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

// the fitted shape between a direction's own ends
double PressField::fittedSink(const RingCurve& curve, double radius) const noexcept
{
  SurfaceProfile profile = *fittedCurve_;
  const double scale = curve.sink / profile.sink;
  profile.inner = curve.inner;
  profile.sink = curve.sink;
  profile.slope = curve.sink / (curve.meet - curve.inner);
  profile.control = { scale * profile.control[0], scale * profile.control[1] };
  profile.rest *= scale; // so that it ends where it does elsewhere
  return profile.sinkAt(radius);
}

// of the smooth surface: what the paper gives every way from the contact
inline double PressField::smoothSink(double distance, const RingCurve& curve) const noexcept
{
  const bool isFitted = fittedCurve_ && curve.sink > 0.0 && curve.meet > curve.inner;
  // no deeper than the tool, which on a rough surface is deeper at the circle than the contact says
  const double deepest = std::max(deepest_, curve.sink);
  return std::min(isFitted ? fittedSink(curve, distance) : curve.sinkAt(distance), deepest);
}

// a side below the tool goes down with the surface above it, less and less with its own depth, so
// that it is compressed and does not fold
[[gnu::noinline]] double PressField::sideSink(const GeodesicCoordinates& geodesic,
  const Eigen::Vector3d& rest, const RingCurve& curve, const ToolBody& body) const noexcept
{
  const double toTool = body.lowest(rest, normal_);
  const double below = std::max(0.0, -heightOverFit(geodesic));
  const double above = std::isfinite(toTool) ? std::min(below - toTool, deepest_) : 0.0;
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
    const double toTool = body.lowest(rest, normal_);
    sink = std::isfinite(toTool) ? std::max(0.0, -toTool) : curve.sink;
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
    sink += fade * std::max(left, -sink);
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
  const Eigen::Vector3d sunk = rest - sink * normal_;
  if (!isUnder && body.contains(sunk))
  {
    // infinite where the tool points along the surface or away from it
    if (const double up = body.lowest(sunk, normal_); std::isfinite(up))
    {
      return { sink - up, Zone::Contact };
    }
  }
  return { sink, isUnder ? Zone::Contact : Zone::Ring };
}

} // namespace palp
