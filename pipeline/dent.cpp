#include "pipeline/dent.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

constexpr double kFront = 0.5;      // [-] cosine to the contact normal: steeper surface is unrolled
constexpr double kSeedFacing = 0.2; // [-] cosine: the surface that was touched, not its far side
constexpr double kStillOnTool = 0.9;       // [-] of the radius where the tool leaves the surface
constexpr double kWithinBase = 1.0 - 1e-9; // [-]
constexpr double kVertical = 1e6;          // [-] slope of a shaft
constexpr std::int32_t kAtRest = -1;

// position of a direction among evenly spaced ones, 0 to 4 without trigonometry
double quarterTurns(double x, double y) noexcept
{
  const double sum = std::abs(x) + std::abs(y);
  if (!(sum > 0.0))
  {
    return 0.0;
  }
  const double t = y / sum;
  return x < 0.0 ? 2.0 - t : (y < 0.0 ? 4.0 + t : t);
}

Eigen::Vector2d directionAt(double turns) noexcept
{
  const int quarter = static_cast<int>(turns);
  const double f = turns - quarter;
  const Eigen::Vector2d first = Eigen::Vector2d(1.0 - f, f).normalized();
  const Eigen::Vector2d turned(-first.y(), first.x());
  return (quarter & 2 ? -1.0 : 1.0) * (quarter & 1 ? turned : first);
}

// root of a function that is negative at 0 and positive at the end, by the Illinois rule
template <typename Function>
double rootBefore(double end, double valueAtEnd, double valueAtZero, Function function) noexcept
{
  double low = 0.0;
  double high = end;
  double atLow = valueAtZero;
  double atHigh = std::min(valueAtEnd, end);
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

Dent::Dent(std::span<const float> rest, std::span<const Triangle> triangles)
  : rest_(rest)
  , umbrella_(rest.size() / 3, triangles)
  , slot_(rest.size() / 3, kAtRest)
{
}

std::size_t Dent::bytes() const noexcept
{
  return umbrella_.bytes() + slot_.capacity() * sizeof(slot_[0]);
}

Eigen::Vector3d Dent::rest(std::int32_t point) const noexcept
{
  const float* p = rest_.data() + 3 * static_cast<std::size_t>(point);
  return { p[0], p[1], p[2] };
}

double Dent::distance(std::size_t indexInTouched) const noexcept
{
  const Node& node = nodes_[indexInTouched];
  return std::hypot(node.u, node.v);
}

std::vector<Triangle> Dent::triangles() const
{
  std::vector<Triangle> all;
  all.reserve(2 * touched_.size());
  for (std::size_t i = 0; i < touched_.size(); ++i)
  {
    const auto around = umbrella_.around(touched_[i]);
    for (std::size_t k = 1; nodes_[i].moved && k < around.size(); ++k)
    {
      if (around[k - 1] == Umbrella::kEnd || around[k] == Umbrella::kEnd)
      {
        continue;
      }
      // a triangle belongs to the first of its displaced corners
      const std::int32_t a = slot_[static_cast<std::size_t>(around[k - 1])];
      const std::int32_t b = slot_[static_cast<std::size_t>(around[k])];
      const auto owner = static_cast<std::int32_t>(i);
      const auto isEarlier = [&](std::int32_t slot)
      { return slot < owner && nodes_[static_cast<std::size_t>(slot)].moved; };
      if (a != kAtRest && b != kAtRest && !isEarlier(a) && !isEarlier(b))
      {
        all.push_back({ owner, a, b });
      }
    }
  }
  return all;
}

void Dent::reset(const DentArrays& arrays)
{
  std::copy(rest_.begin(), rest_.end(), arrays.points);
  std::fill_n(arrays.displacement, rest_.size(), 0.0F);
  std::fill_n(arrays.zone, slot_.size(), static_cast<unsigned char>(Zone::Rest));
  std::fill(slot_.begin(), slot_.end(), kAtRest);
  touched_.clear();
  nodes_.clear();
  outer_ = 0.0;
  for (std::size_t i = 0; i < slot_.size(); ++i)
  {
    computeNormal(static_cast<std::int32_t>(i), arrays);
  }
}

void Dent::update(const Press& press, const DentArrays& arrays)
{
  forgetPress(arrays);
  if (press.contact.touching() && press.contact.center.allFinite())
  {
    const ToolBody body(press.tip, press.pose);
    grow(press, body);
    fitSurface();
    layRing(body);
    displace(body, arrays);
  }
  for (const std::int32_t point : before_)
  {
    if (slot_[static_cast<std::size_t>(point)] == kAtRest)
    {
      computeNormal(point, arrays);
    }
  }
  for (const std::int32_t point : touched_)
  {
    computeNormal(point, arrays);
  }
}

void Dent::forgetPress(const DentArrays& arrays)
{
  before_.swap(touched_);
  touched_.clear();
  nodes_.clear();
  outer_ = 0.0;
  for (const std::int32_t point : before_)
  {
    const auto at = static_cast<std::size_t>(point);
    std::copy_n(rest_.data() + 3 * at, 3, arrays.points + 3 * at);
    std::fill_n(arrays.displacement + 3 * at, 3, 0.0F);
    arrays.zone[at] = static_cast<unsigned char>(Zone::Rest);
    slot_[at] = kAtRest;
  }
}

bool Dent::faces(std::int32_t point, const Eigen::Vector3d& normal) const noexcept
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
std::int32_t Dent::findSeed(const Contact& contact) const noexcept
{
  const auto squareTo = [&](std::int32_t point)
  { return (rest(point) - contact.center).squaredNorm(); };
  std::int32_t best = seed_;
  double square = squareTo(best);
  double longestEdge = 0.0;
  for (bool better = true; better;)
  {
    better = false;
    longestEdge = 0.0;
    for (const std::int32_t next : umbrella_.around(best))
    {
      if (next == Umbrella::kEnd)
      {
        continue;
      }
      longestEdge = std::max(longestEdge, (rest(next) - rest(best)).squaredNorm());
      if (const double candidate = squareTo(next); candidate < square)
      {
        square = candidate;
        best = next;
        better = true;
        break;
      }
    }
  }
  if (square <= longestEdge && faces(best, contact.normal))
  {
    return best;
  }

  best = kAtRest;
  square = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < slot_.size(); ++i)
  {
    const auto point = static_cast<std::int32_t>(i);
    if (const double candidate = squareTo(point);
        candidate < square && faces(point, contact.normal))
    {
      square = candidate;
      best = point;
    }
  }
  return best;
}

void Dent::grow(const Press& press, const ToolBody& body)
{
  const Eigen::Vector3d normal = press.contact.normal;
  const Eigen::Vector3d tangent = normal.unitOrthogonal();
  frame_ << tangent.transpose(), normal.cross(tangent).transpose(), normal.transpose();
  center_ = press.contact.center;
  inner_ = press.contactRadius;
  deepest_ = press.contact.depth;
  outer_ = palp::ringRadius(press.tip, press.contact.depth, inner_, press.extentRadius);

  const std::int32_t seed = findSeed(press.contact);
  if (seed == kAtRest)
  {
    return;
  }
  seed_ = seed;
  queue_.clear();
  meet(seed, seen(seed), body);
  for (std::size_t i = 0; i < queue_.size(); ++i)
  {
    const auto from = static_cast<std::size_t>(queue_[i]);
    const auto around = umbrella_.around(touched_[from]);
    for (std::size_t k = 1; k < around.size(); ++k)
    {
      if (around[k - 1] != Umbrella::kEnd && around[k] != Umbrella::kEnd)
      {
        expand(from, around[k - 1], around[k], body);
      }
    }
  }
}

// meets the corners of a triangle that has one within the dent
void Dent::expand(std::size_t from, std::int32_t a, std::int32_t b, const ToolBody& body)
{
  const auto isSettled = [&](std::int32_t point)
  {
    const std::int32_t slot = slot_[static_cast<std::size_t>(point)];
    return slot != kAtRest && nodes_[static_cast<std::size_t>(slot)].front;
  };
  if (isSettled(a) && isSettled(b))
  {
    return;
  }
  bool front = nodes_[from].front;
  if (front)
  {
    const Eigen::Vector3d p = rest(touched_[from]);
    const Eigen::Vector3d area = (rest(a) - p).cross(rest(b) - p);
    const double towards = area.dot(frame_.row(2));
    front = towards > 0.0 && towards * towards > kFront * kFront * area.squaredNorm();
  }
  for (const std::int32_t point : { a, b })
  {
    if (isSettled(point))
    {
      continue;
    }
    Node node = seen(point);
    node.front = front;
    if (!front)
    {
      const Eigen::Vector2d flat = unrolled(touched_[from], point == a ? b : a, point);
      node.u = flat.x();
      node.v = flat.y();
    }
    meet(point, node, body);
  }
}

// takes a point, or a shorter way to one that was met before
void Dent::meet(std::int32_t point, const Node& node, const ToolBody& body)
{
  constexpr double kShorter = 0.998; // [-] of the square: ends the search for still shorter ways
  const double square = node.u * node.u + node.v * node.v;
  std::int32_t& slot = slot_[static_cast<std::size_t>(point)];
  if (slot == kAtRest)
  {
    slot = static_cast<std::int32_t>(touched_.size());
    touched_.push_back(point);
    nodes_.push_back(node);
  }
  else
  {
    Node& known = nodes_[static_cast<std::size_t>(slot)];
    if (!node.front && !(square < kShorter * (known.u * known.u + known.v * known.v)))
    {
      return;
    }
    known = node;
  }
  Node& met = nodes_[static_cast<std::size_t>(slot)];
  met.moved = square < outer_ * outer_ || body.inside(rest(point)) > 0.0;
  if (met.moved)
  {
    queue_.push_back(slot);
  }
}

// a point in front of the tool: its distance is seen along the normal at the contact circle, as r
// is, and becomes the straight distance towards R_d
Dent::Node Dent::seen(std::int32_t point) const noexcept
{
  const Eigen::Vector3d local = frame_ * (rest(point) - center_);
  const double square = local.x() * local.x() + local.y() * local.y();
  double stretch = 1.0;
  if (square > inner_ * inner_)
  {
    const double straight = local.norm();
    const double t = std::min(1.0, (straight - inner_) / (outer_ - inner_));
    stretch += t * t * (straight / std::sqrt(square) - 1.0);
  }
  return { .x = local.x(),
    .y = local.y(),
    .z = local.z(),
    .u = stretch * local.x(),
    .v = stretch * local.y(),
    .front = true,
    .moved = false };
}

// the way to a point across the edge between two others, straight where their triangle is laid into
// the plane of their own ways; along an edge where it is not seen through the first
Eigen::Vector2d Dent::unrolled(
  std::int32_t from, std::int32_t beside, std::int32_t point) const noexcept
{
  const auto wayTo = [&](std::int32_t slot)
  {
    const Node& node = nodes_[static_cast<std::size_t>(slot)];
    return Eigen::Vector2d(node.u, node.v);
  };
  const Eigen::Vector2d first = wayTo(slot_[static_cast<std::size_t>(from)]);
  const Eigen::Vector3d arm = rest(point) - rest(from);
  const double firstWay = first.norm();
  double way = firstWay + arm.norm();
  Eigen::Vector2d towards = first;
  if (const std::int32_t slot = slot_[static_cast<std::size_t>(beside)]; slot != kAtRest)
  {
    // the edge on the x axis, the contact's centre below it, the point above
    const Eigen::Vector2d second = wayTo(slot);
    const Eigen::Vector3d edge = rest(beside) - rest(from);
    const double length = std::max(edge.norm(), 1e-12);
    const double x = edge.dot(arm) / length;
    const double y = edge.cross(arm).norm() / length;
    const double square = second.squaredNorm();
    const double centerX = (firstWay * firstWay - square + length * length) / (2.0 * length);
    const double centerY = std::sqrt(std::max(0.0, firstWay * firstWay - centerX * centerX));
    const double crossing = centerX + (x - centerX) * centerY / std::max(centerY + y, 1e-12);
    if (crossing >= 0.0 && crossing <= length)
    {
      way = std::hypot(x - centerX, y + centerY);
      towards = (length - crossing) * first + crossing * second;
    }
  }
  way = std::max(way, (rest(point) - center_).norm());
  const double norm = towards.norm();
  return norm > 0.0 ? Eigen::Vector2d(way / norm * towards) : Eigen::Vector2d(way, 0.0);
}

// least squares over the points around the contact, weighted so that none enters with a jump
void Dent::fitSurface()
{
  constexpr double kReach = 1.5; // [-] of the contact radius
  double reach = kReach * inner_;
  if (touched_.empty())
  {
    return;
  }
  for (const std::int32_t next : umbrella_.around(seed_))
  {
    if (next != Umbrella::kEnd)
    {
      reach = std::max(reach, 2.0 * kReach * (rest(next) - rest(seed_)).norm());
    }
  }
  Eigen::Matrix<double, 6, 6> sums = Eigen::Matrix<double, 6, 6>::Zero();
  Quadric heights = Quadric::Zero();
  for (const Node& node : nodes_)
  {
    const double x = node.x / reach;
    const double y = node.y / reach;
    const double left = 1.0 - x * x - y * y;
    if (!node.front || !(left > 0.0))
    {
      continue;
    }
    Quadric terms;
    terms << 1.0, x, y, x * x, x * y, y * y;
    sums.selfadjointView<Eigen::Lower>().rankUpdate(terms, left * left);
    heights += left * left * node.z * terms;
  }
  // a trace of stiffness keeps what few points leave open at zero
  sums.diagonal() += Quadric::Constant(1e-6 * sums(0, 0) + 1e-12);
  const Quadric scaled = sums.selfadjointView<Eigen::Lower>().ldlt().solve(heights);
  const double first = 1.0 / reach;
  const double second = first * first;
  Quadric scale;
  scale << 1.0, first, first, second, second, second;
  quadric_ = scaled.cwiseProduct(scale);
}

double Dent::surfaceHeight(double x, double y) const noexcept
{
  return quadric_[0] + x * (quadric_[1] + x * quadric_[3] + y * quadric_[4]) +
    y * (quadric_[2] + y * quadric_[5]);
}

// P0, P1 and P2 of Fig. 5(b) for every direction, from the tool and the fitted surface
void Dent::layRing(const ToolBody& body)
{
  const Eigen::Vector3d normal = frame_.row(2);
  for (int k = 0; k < kDirections; ++k)
  {
    const Eigen::Vector2d towards = directionAt(4.0 * k / kDirections);
    const Eigen::Vector3d outwards = frame_.topRows<2>().transpose() * towards;
    // how far the tool is above the undeformed surface, less than zero where it is pressed in
    const auto gap = [&](double radius)
    {
      const Eigen::Vector2d at = radius * towards;
      return body.lowest(center_ + radius * outwards, normal) - surfaceHeight(at.x(), at.y());
    };
    const double atCenter = gap(0.0);
    RingCurve& curve = ring_[static_cast<std::size_t>(k)];
    if (!(atCenter < 0.0))
    {
      curve = makeRingCurve(0.0, 0.0, kVertical, outer_);
      continue;
    }
    double end = inner_ / kStillOnTool;
    double atEnd = gap(end);
    if (!std::isfinite(atEnd))
    {
      end = kWithinBase * inner_; // the tool ends in its shaft there, not above the surface
      atEnd = gap(end);
    }
    const double contact =
      atEnd > 0.0 ? kStillOnTool * rootBefore(end, atEnd, atCenter, gap) : std::min(inner_, end);
    const double step = 1e-3 * contact;
    const double sink = gap(contact);
    const double before = sink - gap(contact - step);
    const double after = gap(contact + step) - sink;
    // at the rim of the base the flank goes on; a flat base ends in its shaft
    const double slope = std::isfinite(after) ? 0.5 * (before + after) / step
      : before > 1e-3 * step                  ? before / step
                                              : kVertical;
    curve = makeRingCurve(contact, -sink, slope, outer_);
  }
}

RingCurve Dent::curveTowards(double x, double y) const noexcept
{
  const double turns = quarterTurns(x, y) * (kDirections / 4);
  const auto below = static_cast<std::size_t>(turns);
  const double v = turns - static_cast<double>(below);
  const RingCurve& a = ring_[below % kDirections];
  const RingCurve& b = ring_[(below + 1) % kDirections];
  const auto between = [v](double first, double second) { return first + v * (second - first); };
  return { between(a.inner, b.inner), between(a.sink, b.sink), between(a.meet, b.meet), outer_ };
}

// how far a point sinks along the contact normal
double Dent::sinkOf(const Node& node, const RingCurve& curve, double toTool) const noexcept
{
  const double radius = std::hypot(node.u, node.v);
  if (!node.front)
  {
    return std::min(curve.sinkAt(radius), deepest_);
  }
  if (radius <= curve.inner)
  {
    return std::isfinite(toTool) ? std::max(0.0, -toTool) : curve.sink;
  }
  // what the fit leaves of the surface goes with it at the contact circle and is left behind at R_d
  const double sink = curve.sinkAt(radius);
  const double t = std::min(1.0, (radius - curve.inner) / (curve.outer - curve.inner));
  const double fade = (1.0 - t) * (1.0 - t) * (1.0 + 2.0 * t);
  return sink + std::clamp(fade * (node.z - surfaceHeight(node.x, node.y)), -sink, sink);
}

void Dent::displace(const ToolBody& body, const DentArrays& arrays)
{
  const Eigen::Vector3d normal = frame_.row(2);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
  {
    const Node& node = nodes_[i];
    if (!node.moved)
    {
      continue;
    }
    const RingCurve curve = curveTowards(node.u, node.v);
    const Eigen::Vector3d start = rest(touched_[i]);
    const bool onTool = node.front && std::hypot(node.u, node.v) <= curve.inner;
    double sink = sinkOf(node, curve, onTool ? body.lowest(start, normal) : 0.0);
    Zone zone = onTool && sink > 0.0 ? Zone::Contact : Zone::Ring;
    const Eigen::Vector3d sunk = start - sink * normal;
    if (!onTool && body.inside(sunk) > 0.0)
    {
      sink -= body.lowest(sunk, normal);
      zone = Zone::Contact;
    }
    const auto at = static_cast<std::size_t>(touched_[i]);
    for (Eigen::Index k = 0; k < 3; ++k)
    {
      const std::size_t to = 3 * at + static_cast<std::size_t>(k);
      arrays.displacement[to] = static_cast<float>(-sink * normal[k]);
      arrays.points[to] = static_cast<float>(start[k] - sink * normal[k]);
    }
    arrays.zone[at] = static_cast<unsigned char>(zone);
  }
}

// one way for rest and dent, so that rest comes back to the bit
void Dent::computeNormal(std::int32_t point, const DentArrays& arrays) const noexcept
{
  const auto position = [&](std::int32_t of)
  {
    const float* p = arrays.points + 3 * static_cast<std::size_t>(of);
    return Eigen::Vector3f(p[0], p[1], p[2]);
  };
  const Eigen::Vector3f center = position(point);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Vector3f last = Eigen::Vector3f::Zero();
  bool open = false;
  for (const std::int32_t next : umbrella_.around(point))
  {
    if (next == Umbrella::kEnd)
    {
      open = false;
      continue;
    }
    const Eigen::Vector3f edge = position(next) - center;
    if (open)
    {
      sum += last.cross(edge);
    }
    last = edge;
    open = true;
  }
  const float length = sum.norm();
  const Eigen::Vector3f normal =
    length > 0.0F ? Eigen::Vector3f(sum / length) : Eigen::Vector3f(Eigen::Vector3f::Zero());
  std::copy_n(normal.data(), 3, arrays.normals + 3 * static_cast<std::size_t>(point));
}

} // namespace palp
