#include "pipeline/press_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

constexpr double kFront = 0.5;      // [-] cosine to the contact normal: steeper surface is unrolled
constexpr double kSeedFacing = 0.2; // [-] cosine: the surface that was touched, not its far side
constexpr double kShorter = 0.999;  // [-] of the distance: ends the search for still shorter ways
constexpr double kTiny = 1e-12;     // [m]

} // namespace

PressRegion::PressRegion(std::span<const float> rest, std::span<const Triangle> triangles)
  : rest_(rest)
  , umbrella_(rest.size() / 3, triangles)
  , slot_(rest.size() / 3, kNowhere)
{
}

std::size_t PressRegion::bytes() const noexcept
{
  return umbrella_.bytes() + slot_.capacity() * sizeof(slot_[0]);
}

void PressRegion::clear() noexcept
{
  for (const std::int32_t point : points_)
  {
    slot_[static_cast<std::size_t>(point)] = kNowhere;
  }
  points_.clear();
  places_.clear();
  outer_ = 0.0;
}

double PressRegion::edgeLength() const noexcept
{
  double sum = 0.0;
  int count = 0;
  for (const std::int32_t next : umbrella_.around(seed_))
  {
    if (next != Umbrella::kEnd)
    {
      sum += (rest(next) - rest(seed_)).norm();
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

bool PressRegion::faces(std::int32_t point, const Eigen::Vector3d& normal) const noexcept
{
  const Eigen::Vector3d p = rest(point);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto around = umbrella_.around(point);
  for (std::size_t i = 1; i < around.size(); ++i)
  {
    if (around[i - 1] != Umbrella::kEnd && around[i] != Umbrella::kEnd)
    {
      sum += (rest(around[i - 1]) - p).cross(rest(around[i]) - p);
    }
  }
  return sum.dot(normal) > kSeedFacing * sum.norm();
}

// the nearest point that faces the tool: downhill from the last one, or, where that ends on
// another sheet or the tool has jumped, through all points
std::int32_t PressRegion::findSeed(const Contact& contact) const noexcept
{
  std::int32_t best = seed_;
  double square = (rest(best) - contact.center).squaredNorm();
  double longestEdge = 0.0;
  for (bool better = true; better;)
  {
    better = false;
    longestEdge = 0.0;
    const std::int32_t from = best;
    for (const std::int32_t next : umbrella_.around(from))
    {
      if (next == Umbrella::kEnd)
      {
        continue;
      }
      longestEdge = std::max(longestEdge, (rest(next) - rest(from)).squaredNorm());
      if (const double candidate = (rest(next) - contact.center).squaredNorm(); candidate < square)
      {
        square = candidate;
        best = next;
        better = true;
      }
    }
  }
  return square <= longestEdge && faces(best, contact.normal) ? best : findNearest(contact);
}

std::int32_t PressRegion::findNearest(const Contact& contact) const noexcept
{
  std::int32_t best = kNowhere;
  double square = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < slot_.size(); ++i)
  {
    const auto point = static_cast<std::int32_t>(i);
    if (const double candidate = (rest(point) - contact.center).squaredNorm();
        candidate < square && faces(point, contact.normal))
    {
      square = candidate;
      best = point;
    }
  }
  return best;
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
  const std::int32_t seed = findSeed(contact);
  if (seed == kNowhere)
  {
    return;
  }
  seed_ = seed;
  queue_.clear();
  meet(seed, placeInFront(rest(seed)), body);
  if (!places_.front().within)
  {
    // a tool between the points of a coarse mesh: a finer patch can still show its dent
    places_.front().within = true;
    queue_.push_back(0);
  }
  for (std::size_t i = 0; i < queue_.size(); ++i)
  {
    const auto from = static_cast<std::size_t>(queue_[i]);
    const auto around = umbrella_.around(points_[from]);
    bool open = true; // the neighbour before has no settled place
    std::int32_t before = Umbrella::kEnd;
    for (const std::int32_t next : around)
    {
      const bool isOpen = next != Umbrella::kEnd && !isSettled(next);
      if (before != Umbrella::kEnd && next != Umbrella::kEnd && (open || isOpen))
      {
        expand(from, before, next, body);
      }
      before = next;
      open = isOpen && !isSettled(next);
    }
  }
}

// meets the corners of a triangle that has one within the dent
void PressRegion::expand(std::size_t from, std::int32_t a, std::int32_t b, const ToolBody& body)
{
  bool front = places_[from].front;
  if (front)
  {
    const Eigen::Vector3d p = rest(points_[from]);
    const Eigen::Vector3d area = (rest(a) - p).cross(rest(b) - p);
    const double towards = area.dot(axes_.row(2));
    front = towards > 0.0 && towards * towards > kFront * kFront * area.squaredNorm();
  }
  for (const std::int32_t point : { a, b })
  {
    if (isSettled(point))
    {
      continue;
    }
    Place place = placeInFront(rest(point));
    place.front = front;
    if (!front)
    {
      place.way = unrolled(points_[from], point == a ? b : a, point);
      place.distance = place.way.norm();
    }
    meet(point, place, body);
  }
}

// takes a point, or a shorter way to one that was met before
void PressRegion::meet(std::int32_t point, Place place, const ToolBody& body)
{
  std::int32_t& slot = slot_[static_cast<std::size_t>(point)];
  if (slot != kNowhere && !place.front &&
    !(place.distance < kShorter * places_[static_cast<std::size_t>(slot)].distance))
  {
    return;
  }
  place.within = place.distance < outer_ || body.inside(rest(point)) > 0.0;
  if (slot == kNowhere)
  {
    slot = static_cast<std::int32_t>(points_.size());
    points_.push_back(point);
    places_.push_back(place);
  }
  else
  {
    places_[static_cast<std::size_t>(slot)] = place;
  }
  if (place.within)
  {
    queue_.push_back(slot);
  }
}

Place PressRegion::placeInFront(const Eigen::Vector3d& point) const noexcept
{
  const Eigen::Vector3d local = axes_ * (point - center_);
  const Eigen::Vector2d across = local.head<2>();
  const double square = across.squaredNorm();
  const double seen = std::sqrt(square);
  double stretch = 1.0;
  if (seen > inner_)
  {
    const double straight = std::sqrt(square + local.z() * local.z());
    const double t = std::min(1.0, (straight - inner_) / (outer_ - inner_));
    stretch += t * t * (straight / seen - 1.0);
  }
  return { .local = local,
    .way = stretch * across,
    .distance = stretch * seen,
    .front = true,
    .within = false };
}

// the way to a point across the edge between two others, straight where their triangle is laid into
// the plane of their own ways; along an edge where it is not seen through the first
Eigen::Vector2d PressRegion::unrolled(
  std::int32_t from, std::int32_t beside, std::int32_t point) const noexcept
{
  const Place& first = places_[static_cast<std::size_t>(find(from))];
  const Eigen::Vector3d arm = rest(point) - rest(from);
  double distance = first.distance + arm.norm();
  Eigen::Vector2d towards = first.way;
  if (const std::int32_t slot = find(beside); slot != kNowhere)
  {
    // the edge on the x axis, the contact's centre below it, the point above
    const Place& second = places_[static_cast<std::size_t>(slot)];
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
      towards = (length - crossing) * first.way + crossing * second.way;
    }
  }
  distance = std::max(distance, (rest(point) - center_).norm());
  const double norm = towards.norm();
  return norm > 0.0 ? Eigen::Vector2d(distance / norm * towards) : Eigen::Vector2d(distance, 0.0);
}

std::vector<Triangle> PressRegion::triangles() const
{
  std::vector<Triangle> all;
  all.reserve(2 * points_.size());
  const auto isWithin = [&](std::int32_t slot)
  { return places_[static_cast<std::size_t>(slot)].within; };
  for (std::int32_t owner = 0; owner < static_cast<std::int32_t>(points_.size()); ++owner)
  {
    if (!isWithin(owner))
    {
      continue;
    }
    std::int32_t before = Umbrella::kEnd;
    for (const std::int32_t next : umbrella_.around(points_[static_cast<std::size_t>(owner)]))
    {
      if (before != Umbrella::kEnd && next != Umbrella::kEnd)
      {
        // a triangle belongs to the first of its corners within the dent
        const std::int32_t a = find(before);
        const std::int32_t b = find(next);
        if ((a > owner || !isWithin(a)) && (b > owner || !isWithin(b)))
        {
          all.push_back({ owner, a, b });
        }
      }
      before = next;
    }
  }
  return all;
}

} // namespace palp
