// Where a press region begins to grow, the point of the surface that is nearest to the contact, and
// where it goes on between the points of a coarse mesh: edges through the dent from outside to
// outside.

#include "pipeline/deform/press_region.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

constexpr double kFacing = 0.2;     // [-] cosine: the surface that was touched, not its far side
constexpr double kCoarse = 0.5;     // [-] outer radii: shorter edges cross no more than the rim
constexpr double kTinyArea = 1e-24; // [m^2]

// from the contact's center, seen along its normal [m]
double distanceOfEdge(const GeodesicCoordinates& a, const GeodesicCoordinates& b) noexcept
{
  const Eigen::Vector2d from = a.local.head<2>();
  const Eigen::Vector2d edge = b.local.head<2>() - from;
  const double along =
    std::clamp(-from.dot(edge) / std::max(edge.squaredNorm(), kTinyArea), 0.0, 1.0);
  return (from + along * edge).norm();
}

} // namespace

bool PressRegion::faces(std::int32_t point, const Eigen::Vector3d& normal) const noexcept
{
  const Eigen::Vector3d area = areaAround(point);
  return area.dot(normal) > kFacing * area.norm();
}

// the nearest point that faces the tool: downhill from the last one, or, where that ends on
// another sheet or the tool has jumped, from the nearest of a few, or else through all points
std::int32_t PressRegion::findSeed(const Contact& contact) const noexcept
{
  const auto few = static_cast<std::size_t>(std::sqrt(static_cast<double>(slot_.size())));
  std::int32_t best = descentStep(seed_, contact);
  if (best < 0)
  {
    best = descentStep(findClosestPoint(contact, few), contact);
  }
  return best < 0 ? findClosestPoint(contact, 1) : best;
}

// to the nearest point that a way of ever nearer points leads to; -1 when the contact is not there
std::int32_t PressRegion::descentStep(std::int32_t start, const Contact& contact) const noexcept
{
  if (start < 0)
  {
    return -1;
  }
  std::int32_t best = start;
  double square = (rest(best) - contact.center).squaredNorm();
  double longestEdge = 0.0;
  for (bool better = true; better;)
  {
    better = false;
    longestEdge = 0.0;
    const std::int32_t from = best;
    for (const std::int32_t next : rings_.around(from))
    {
      if (next == VertexRings::kEnd)
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
  return square <= longestEdge && faces(best, contact.normal) ? best : -1;
}

// of every so many points the nearest one that faces the tool; -1 when none does
std::int32_t PressRegion::findClosestPoint(const Contact& contact, std::size_t every) const noexcept
{
  std::int32_t best = -1;
  double square = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < slot_.size(); i += every)
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

// takes an end of each edge that leads through the dent from one point outside to another, so that
// a finer patch has both of its triangles; whether there was one
bool PressRegion::reachAcrossEdges()
{
  forEachTriangle(
    [&](const Triangle& corners)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const auto& a = geodesics_[static_cast<std::size_t>(corners[k])];
        const auto& b = geodesics_[static_cast<std::size_t>(corners[(k + 1) % 3])];
        if (!a.within && !b.within && crosses(a, b))
        {
          queue_.push_back(corners[k]);
        }
      }
    });
  for (const std::int32_t index : queue_)
  {
    geodesics_[static_cast<std::size_t>(index)].within = true;
  }
  return !queue_.empty();
}

bool PressRegion::isCoarse() const noexcept
{
  return longestEdge_ > kCoarse * outer_;
}

bool PressRegion::crosses(const GeodesicCoordinates& a, const GeodesicCoordinates& b) const noexcept
{
  return isCoarse() && a.isFront() && b.isFront() && distanceOfEdge(a, b) < outer_;
}

bool PressRegion::spansContact(
  const GeodesicCoordinates& a, const GeodesicCoordinates& b) const noexcept
{
  return (a.local - b.local).norm() > inner_ && distanceOfEdge(a, b) < inner_;
}

} // namespace palp
