#include "pipeline/deform/dent.h"

#include "haptics/numerics/smooth_step.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

bool isFinite(const SurfaceProfile& profile)
{
  return std::isfinite(profile.inner) && std::isfinite(profile.outer) &&
    profile.outer > profile.inner && profile.inner > 0.0 && profile.sink > 0.0 &&
    std::isfinite(profile.sink) && std::isfinite(profile.slope) &&
    std::isfinite(profile.control[0]) && std::isfinite(profile.control[1]);
}

bool isFinite(const Press& press)
{
  return std::isfinite(press.contact.depth) && press.contact.center.allFinite() &&
    press.contact.normal.allFinite() && press.pose.apex.allFinite() &&
    press.pose.axis.allFinite() && std::isfinite(press.contactRadius) &&
    std::isfinite(press.extentRadius) && press.carried.allFinite() &&
    (!press.fitted || isFinite(*press.fitted));
}

constexpr double kWider = 1.0 + 1e-6; // [-] beyond rounding
constexpr int kUprightPasses = 30;
constexpr double kUpright = 0.05; // [-] fraction of its area at rest that a side keeps at least

// x, y, z in one register
using Lanes = float __attribute__((vector_size(16)));

// y, z, x
Lanes turned(Lanes v) noexcept
{
  return __builtin_shufflevector(v, v, 1, 2, 0, 3);
}

} // namespace

Dent::Dent(std::span<const float> rest, std::span<const Triangle> triangles)
  : rest_(rest)
  , region_(rest, triangles)
{
}

void Dent::reset(const DentArrays& arrays)
{
  std::copy(rest_.begin(), rest_.end(), arrays.points);
  std::fill_n(arrays.displacement, rest_.size(), 0.0F);
  std::fill_n(arrays.zone, region_.pointCount(), static_cast<unsigned char>(Zone::Rest));
  region_.clear();
  for (std::size_t i = 0; i < region_.pointCount(); ++i)
  {
    computeNormal(static_cast<std::int32_t>(i), arrays);
  }
}

void Dent::update(const Press& press, const DentArrays& arrays)
{
  forgetPress(arrays);
  const Contact& contact = press.contact;
  if (contact.touching() && isFinite(press))
  {
    carried_ = press.carried - press.carried.dot(contact.normal) * contact.normal;
    ToolPose pose = press.pose;
    pose.apex -= carried_;
    body_.emplace(press.tip, pose);
    const double inner = press.fitted ? press.fitted->inner : press.contactRadius;
    const double extent = press.fitted ? press.fitted->reach() : press.extentRadius;
    const double outer = ringRadius(press.tip, contact.depth, inner, extent);
    lay(press, outer);
    if (const double reach = field_.reach(); reach > kWider * outer)
    {
      lay(press, reach);
    }
    displace(0, region_.points().size(), arrays);
    if (region_.hasSides())
    {
      keepSidesUpright(arrays);
    }
  }
  for (const std::int32_t point : before_)
  {
    if (region_.find(point) < 0)
    {
      computeNormal(point, arrays);
    }
  }
  for (const std::int32_t point : region_.points())
  {
    computeNormal(point, arrays);
  }
}

void Dent::deepen(
  std::span<const std::int32_t> touched, const DentArrays& other, const DentArrays& arrays)
{
  const auto depth = [](const DentArrays& of, std::size_t at)
  { return Eigen::Map<const Eigen::Vector3f>(of.displacement + 3 * at).squaredNorm(); };
  for (const std::int32_t point : touched)
  {
    const bool isShared = region_.find(point) >= 0;
    meetsOther_ = meetsOther_ || isShared;
    isShared ? void() : besides_.push_back(point);
    const auto at = static_cast<std::size_t>(point);
    if (depth(other, at) > depth(arrays, at))
    {
      std::copy_n(other.points + 3 * at, 3, arrays.points + 3 * at);
      std::copy_n(other.displacement + 3 * at, 3, arrays.displacement + 3 * at);
      arrays.zone[at] = other.zone[at];
      deepened_.push_back(point);
    }
  }
  for (const std::int32_t point : touched)
  {
    computeNormal(point, arrays);
  }
}

void Dent::lay(const Press& press, double outer)
{
  const double inner = press.fitted ? press.fitted->inner : press.contactRadius;
  Contact contact = press.contact;
  contact.center -= carried_;
  region_.grow(contact, *body_, inner, outer);
  field_.lay(region_, *body_, press.contact.depth, press.fitted, press.isLiteral);
}

void Dent::forgetPress(const DentArrays& arrays)
{
  before_.assign(region_.points().begin(), region_.points().end());
  before_.insert(before_.end(), besides_.begin(), besides_.end());
  besides_.clear();
  deepened_.clear();
  meetsOther_ = false;
  region_.clear();
  for (const std::int32_t point : before_)
  {
    const auto at = static_cast<std::size_t>(point);
    std::copy_n(rest_.data() + 3 * at, 3, arrays.points + 3 * at);
    std::fill_n(arrays.displacement + 3 * at, 3, 0.0F);
    arrays.zone[at] = static_cast<unsigned char>(Zone::Rest);
  }
}

PressField::Sink Dent::sinkAt(
  const GeodesicCoordinates& geodesic, const Eigen::Vector3d& rest) const noexcept
{
  PressField::Sink sink = field_.sinkAt(geodesic, rest, *body_);
  if (geodesic.isBetween())
  {
    const PressField::Sink front =
      field_.sinkAt(region_.geodesicInFront(rest, geodesic.steepness), rest, *body_);
    sink.depth += geodesic.facing * (front.depth - sink.depth);
  }
  sink.depth += geodesic.extra;
  const bool isAsOfField = !geodesic.isBetween() && geodesic.extra == 0.0F;
  return isAsOfField ? sink : field_.keptOutside(sink, rest, *body_);
}

// the contact goes along as a whole; around it, as around one that is about to slip, ever less
Eigen::Vector3d Dent::displacement(const GeodesicCoordinates& geodesic, double sink) const noexcept
{
  const Eigen::Vector3d down = -sink * region_.normal();
  if (carried_.isZero(0.0))
  {
    return down;
  }
  const double inner = region_.inner();
  const double outer = region_.outer();
  double part = 1.0;
  if (geodesic.distance > inner)
  {
    part = std::asin(inner / geodesic.distance) / (0.5 * std::numbers::pi) *
      (1.0 - smoothStep((geodesic.distance - inner) / (outer - inner)));
  }
  return down + part * carried_;
}

void Dent::displace(std::size_t from, std::size_t to, const DentArrays& arrays) const noexcept
{
  const auto points = region_.points();
  const auto geodesics = region_.geodesics();
  for (std::size_t i = from; i < to; ++i)
  {
    if (!geodesics[i].within)
    {
      continue;
    }
    const Eigen::Vector3d rest = region_.rest(points[i]);
    const PressField::Sink sink = sinkAt(geodesics[i], rest);
    const Eigen::Vector3d moved = displacement(geodesics[i], sink.depth);
    const Eigen::Vector3d sunk = rest + moved;
    const auto at = static_cast<std::size_t>(points[i]);
    for (Eigen::Index k = 0; k < 3; ++k)
    {
      arrays.displacement[3 * at + static_cast<std::size_t>(k)] = static_cast<float>(moved[k]);
      arrays.points[3 * at + static_cast<std::size_t>(k)] = static_cast<float>(sunk[k]);
    }
    arrays.zone[at] = static_cast<unsigned char>(sink.zone);
  }
}

// What faces the tool keeps its order under any displacement along the normal. Where a side or an
// overhang would turn over, its lesser sinks are raised, just enough.
void Dent::keepSidesUpright(const DentArrays& arrays)
{
  bool isUpright = false;
  for (int pass = 0; pass < kUprightPasses && !isUpright; ++pass)
  {
    isUpright = true;
    region_.forEachTriangle(
      [&](const Triangle& corners) { isUpright = keepUpright(corners, arrays) && isUpright; });
  }
}

// whether it was, or cannot be
bool Dent::keepUpright(const Triangle& corners, const DentArrays& arrays)
{
  std::array<Eigen::Vector3d, 3> rest;
  std::array<double, 3> sinks{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (!region_.geodesics()[static_cast<std::size_t>(corners[k])].within)
    {
      return true; // hangs from a point at rest
    }
    const std::int32_t point = region_.points()[static_cast<std::size_t>(corners[k])];
    rest[k] = region_.rest(point);
    sinks[k] = -Eigen::Map<const Eigen::Vector3f>(arrays.displacement + 3 * std::ptrdiff_t{ point })
                  .cast<double>()
                  .dot(region_.normal());
  }
  const Eigen::Vector3d first = rest[1] - rest[0];
  const Eigen::Vector3d second = rest[2] - rest[0];
  const Eigen::Vector3d area = first.cross(second);
  // what the sinks take from the area, which is linear in their differences
  const double lost = region_.normal().dot(
    area.cross((sinks[2] - sinks[0]) * first - (sinks[1] - sinks[0]) * second));
  const double whole = area.squaredNorm();
  if (area.dot(region_.normal()) > 0.0 || !(lost > (1.0 - kUpright) * whole))
  {
    return true;
  }
  const double fraction = 1.0 - (1.0 - 2.0 * kUpright) * whole / lost;
  const double most = *std::max_element(sinks.begin(), sinks.end());
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto index = static_cast<std::size_t>(corners[k]);
    region_.sinkFurther(index, fraction * (most - sinks[k]));
    displace(index, index + 1, arrays);
  }
  return false;
}

// one way for rest and dent, so that rest comes back to the bit
void Dent::computeNormal(std::int32_t point, const DentArrays& arrays) const noexcept
{
  const auto position = [&](std::int32_t of)
  {
    const float* p = arrays.points + 3 * static_cast<std::size_t>(of);
    return Lanes{ p[0], p[1], p[2], 0.0F };
  };
  const Lanes center = position(point);
  Lanes sum{};
  Lanes last{};
  for (const std::int32_t next : region_.rings().around(point))
  {
    const Lanes edge = next == VertexRings::kEnd ? Lanes{} : position(next) - center;
    sum += last * turned(edge) - turned(last) * edge;
    last = edge;
  }
  sum = turned(sum);
  const float length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  const float scale = length > 0.0F ? 1.0F / length : 0.0F;
  float* normal = arrays.normals + 3 * static_cast<std::size_t>(point);
  for (int k = 0; k < 3; ++k)
  {
    normal[k] = scale * sum[k];
  }
}

} // namespace palp
