#include "pipeline/deform/press_region.h"

#include "haptics/numerics/smooth_step.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kFront = 0.5;   // [-] cosine to the contact normal: steeper surface is unrolled
constexpr double kSteep = 0.75;  // [-] cosine from which on a way is as long as in space
constexpr double kGentle = 0.91; // [-] cosine of 15 degrees less: no point is steep but a sharp one
constexpr double kSharp = 0.966; // [-] cosine of 15 degrees, half of what kFront leaves to a side
constexpr double kShorter = 0.999; // [-] of the distance: ends the search for still shorter ways
constexpr double kTurn = 10.0;     // [-] inner radii to the one where lengths are true, inverted
constexpr double kTiny = 1e-12;    // [m]

// of a triangle by two of its edges in the frame of the contact; scalars, for a vector would go
// through memory
inline bool facesTool(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, double cosine = kFront) noexcept
{
  const double x = a.y() * b.z() - a.z() * b.y();
  const double y = a.z() * b.x() - a.x() * b.z();
  const double z = a.x() * b.y() - a.y() * b.x();
  return z > 0.0 && z * z > cosine * cosine * (x * x + y * y + z * z);
}

} // namespace

PressRegion::PressRegion(std::span<const float> rest, std::span<const Triangle> triangles)
  : rest_(rest)
  , rings_(rest.size() / 3, triangles)
  , slot_(rest.size() / 3, kNowhere)
{
  for (std::size_t i = 0; i < slot_.size(); ++i)
  {
    slot_[i] |= isSharpAt(static_cast<std::int32_t>(i)) ? kSharpBit : 0;
    longestEdge_ = std::max(longestEdge_, longestEdge(static_cast<std::int32_t>(i)));
  }
}

// whether one triangle of a point may face the tool as kFront asks and another may not at all
bool PressRegion::isSharpAt(std::int32_t point) const noexcept
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  forEachAreaAround(point, [&](const Eigen::Vector3d& area) { mean += area.normalized(); });
  bool isSharp = false;
  forEachAreaAround(point,
    [&](const Eigen::Vector3d& area)
    { isSharp = isSharp || !(area.normalized().dot(mean) > kSharp * mean.norm()); });
  return isSharp;
}

double PressRegion::longestEdge(std::int32_t point) const noexcept
{
  double square = 0.0;
  for (const std::int32_t next : rings_.around(point))
  {
    if (next != VertexRings::kEnd)
    {
      square = std::max(square, (rest(next) - rest(point)).squaredNorm());
    }
  }
  return std::sqrt(square);
}

// whether a triangle of a point may meet the tool
bool PressRegion::isNear(std::int32_t point, const ToolBody& body) const noexcept
{
  constexpr double kUnits = 2.0; // [-] of the depth in the tool over the distance from it
  const double outside = -body.inside(rest(point));
  return outside < kUnits * longestEdge_ && outside < kUnits * longestEdge(point);
}

std::size_t PressRegion::bytes() const noexcept
{
  return rings_.bytes() + slot_.capacity() * sizeof(slot_[0]);
}

void PressRegion::clear() noexcept
{
  for (const std::int32_t point : points_)
  {
    std::int32_t& slot = slot_[static_cast<std::size_t>(point)];
    slot = kNowhere | (slot & kSharpBit);
  }
  points_.clear();
  geodesics_.clear();
  hasSides_ = false;
  outer_ = 0.0;
}

double PressRegion::edgeLength() const noexcept
{
  double sum = 0.0;
  int count = 0;
  for (const std::int32_t next : rings_.around(seed_))
  {
    if (next != VertexRings::kEnd)
    {
      sum += (rest(next) - rest(seed_)).norm();
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

Eigen::Vector3d PressRegion::areaAround(std::int32_t point) const noexcept
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  forEachAreaAround(point, [&](const Eigen::Vector3d& area) { sum += area; });
  return sum;
}

void PressRegion::grow(const Contact& contact, const ToolBody& body, double inner, double outer)
{
  clear();
  const Eigen::Vector3d tangent = contact.normal.unitOrthogonal();
  axes_ << tangent.transpose(), contact.normal.cross(tangent).transpose(),
    contact.normal.transpose();
  center_ = contact.center;
  inner_ = inner;
  outer_ = outer;
  perWidth_ = 1.0 / (outer - inner);
  perTurn_ = kTurn / inner;
  const std::int32_t seed = findSeed(contact);
  if (seed < 0)
  {
    return;
  }
  seed_ = seed;
  queue_.clear();
  settle(seed, toLocal(rest(seed)), body, false);
  if (!geodesics_.front().within)
  {
    // a tool between the points of a coarse mesh: a finer patch can still show its dent
    geodesics_.front().within = true;
    queue_.push_back(0);
  }
  spread(body);
  while (isCoarse() && reachAcrossEdges())
  {
    spread(body);
  }
}

void PressRegion::spread(const ToolBody& body)
{
  std::size_t first = 0; // the queue grows meanwhile
  while (first < queue_.size())
  {
    const auto from = static_cast<std::size_t>(queue_[first++]);
    std::int32_t before = VertexRings::kEnd;
    bool isOpen = false; // what was before has no settled place
    for (const std::int32_t next : rings_.around(points_[from]))
    {
      const bool wasOpen = isOpen;
      isOpen = next != VertexRings::kEnd && !isSettled(next);
      if (before != VertexRings::kEnd && next != VertexRings::kEnd && (wasOpen || isOpen))
      {
        expand(from, before, next, body);
        isOpen = !isSettled(next);
      }
      before = next;
    }
  }
  queue_.clear();
}

// meets the corners of a triangle that has one within the dent
void PressRegion::expand(std::size_t from, std::int32_t a, std::int32_t b, const ToolBody& body)
{
  if (geodesics_[from].isFront())
  {
    const Eigen::Vector3d p = geodesics_[from].local;
    const Eigen::Vector3d atA = toLocal(rest(a));
    const Eigen::Vector3d atB = toLocal(rest(b));
    if (facesTool(atA - p, atB - p))
    {
      const bool isGentle = facesTool(atA - p, atB - p, kGentle);
      settle(a, atA, body, isGentle);
      settle(b, atB, body, isGentle);
      return;
    }
  }
  hasSides_ = true;
  meetAround(a, points_[from], b, body);
  meetAround(b, points_[from], a, body);
}

// takes a point that faces the tool; inlined, for most of the time of growing is spent here
[[gnu::always_inline]] inline void PressRegion::settle(
  std::int32_t point, const Eigen::Vector3d& local, const ToolBody& body, bool isGentle)
{
  if (isSettled(point))
  {
    return;
  }
  const std::size_t index = indexOf(point);
  slot_[static_cast<std::size_t>(point)] |= kSettledBit;
  const bool isSharp = (slot_[static_cast<std::size_t>(point)] & kSharpBit) != 0;
  hasSides_ = hasSides_ || isSharp;
  GeodesicCoordinates& geodesic = geodesics_[index];
  geodesic.local = local;
  geodesic.turns = diamondAngle(local.x(), local.y());
  geodesic.steepness = isGentle && !isSharp ? 0.0F : steepnessAt(point);
  geodesic.distance = distanceInFront(local, geodesic.steepness);
  geodesic.facing = 1.0F;
  geodesic.within = geodesic.distance < outer_ || body.contains(rest(point));
  if (geodesic.within || isNear(point, body))
  {
    queue_.push_back(static_cast<std::int32_t>(index));
  }
}

// takes a point beyond an edge, or a shorter way to one that was met before
void PressRegion::meetAround(
  std::int32_t point, std::int32_t from, std::int32_t beside, const ToolBody& body)
{
  if (isSettled(point))
  {
    return;
  }
  const bool isNew = find(point) < 0;
  GeodesicCoordinates geodesic = geodesicAround(from, beside, point);
  const std::size_t index = indexOf(point);
  if (!isNew && !(geodesic.distance < kShorter * geodesics_[index].distance))
  {
    return;
  }
  geodesic.within = geodesic.distance < outer_ || body.contains(rest(point));
  geodesics_[index] = geodesic;
  if (geodesic.within || isNear(point, body))
  {
    queue_.push_back(static_cast<std::int32_t>(index));
  }
}

// of a point in points(), where it is put if it was not there
[[gnu::always_inline]] inline std::size_t PressRegion::indexOf(std::int32_t point)
{
  std::int32_t& slot = slot_[static_cast<std::size_t>(point)];
  if (slot < 0)
  {
    slot = static_cast<std::int32_t>(points_.size()) << kBits | (slot & kSharpBit);
    points_.push_back(point);
    geodesics_.emplace_back();
  }
  return static_cast<std::size_t>(slot >> kBits);
}

// what turns away is unrolled: the way to it must not grow at once
[[gnu::noinline]] float PressRegion::steepnessAt(std::int32_t point) const noexcept
{
  const double facing = normal().dot(areaAround(point).normalized());
  return static_cast<float>(smoothStep((kSteep - facing) / (kSteep - kFront)));
}

inline double PressRegion::distanceInFront(
  const Eigen::Vector3d& local, double steepness) const noexcept
{
  const double square = local.head<2>().squaredNorm();
  const double seen = std::sqrt(square);
  if (!(seen > inner_))
  {
    return seen;
  }
  const double straight = std::sqrt(square + local.z() * local.z());
  const double t = std::min(1.0, (straight - inner_) * perWidth_);
  const double s = std::min(1.0, perTurn_ * (seen - inner_));
  return seen + std::lerp(t * t, 1.0, steepness) * s * (straight - seen);
}

GeodesicCoordinates PressRegion::geodesicInFront(
  const Eigen::Vector3d& point, float steepness) const noexcept
{
  const Eigen::Vector3d local = toLocal(point);
  return { .local = local,
    .distance = distanceInFront(local, steepness),
    .turns = diamondAngle(local.x(), local.y()),
    .facing = 1.0F,
    .steepness = steepness,
    .within = false };
}

GeodesicCoordinates PressRegion::geodesicBetween(const GeodesicCoordinates& a,
  const GeodesicCoordinates& b, double fraction, const Eigen::Vector3d& point) const noexcept
{
  const auto t = static_cast<float>(fraction);
  GeodesicCoordinates geodesic =
    geodesicInFront(point, a.steepness + t * (b.steepness - a.steepness));
  if (!a.isFront() || !b.isFront())
  {
    const Eigen::Vector2d log = a.logMap() + fraction * (b.logMap() - a.logMap());
    geodesic.turns = diamondAngle(log.x(), log.y());
    geodesic.distance = a.distance + fraction * (b.distance - a.distance);
    geodesic.facing = a.facing + t * (b.facing - a.facing);
  }
  geodesic.extra = a.extra + t * (b.extra - a.extra);
  return geodesic;
}

// the way to a point across the edge between two others, straight where their triangle is laid into
// the plane of their own ways; along an edge where it is not seen through the first
GeodesicCoordinates PressRegion::geodesicAround(
  std::int32_t from, std::int32_t beside, std::int32_t point) const noexcept
{
  const GeodesicCoordinates& first = geodesics_[static_cast<std::size_t>(find(from))];
  const Eigen::Vector3d arm = rest(point) - rest(from);
  double distance = first.distance + arm.norm();
  float turns = first.turns;
  if (const std::int32_t slot = find(beside); slot >= 0)
  {
    // the edge on the x axis, the contact's center below it, the point above
    const GeodesicCoordinates& second = geodesics_[static_cast<std::size_t>(slot)];
    const Eigen::Vector3d edge = rest(beside) - rest(from);
    const double length = std::max(edge.norm(), kTiny);
    const double x = edge.dot(arm) / length;
    const double y = edge.cross(arm).norm() / length;
    const double centerX =
      (first.distance * first.distance - second.distance * second.distance + length * length) /
      (2.0 * length);
    const double below =
      std::sqrt(std::max(0.0, first.distance * first.distance - centerX * centerX));
    const double crossing = centerX + (x - centerX) * below / std::max(below + y, kTiny);
    if (crossing >= 0.0 && crossing <= length)
    {
      distance = std::sqrt((x - centerX) * (x - centerX) + (y + below) * (y + below));
      const Eigen::Vector2d towards =
        (length - crossing) * first.logMap() + crossing * second.logMap();
      turns = diamondAngle(towards.x(), towards.y());
    }
  }
  const Eigen::Vector3d local = axes_ * (rest(point) - center_);
  return { .local = local,
    .distance = std::max(distance, local.norm()),
    .turns = turns,
    .facing = 0.0F,
    .steepness = 1.0F,
    .within = false };
}

} // namespace palp
