#include "haptics/contact/ball/cut_triangle.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

// of the disc's squared radius over the squared side from which on its rim is straight, and sectors
// so much larger than their difference that rounding would be all of it
constexpr double kStraight = 1e4;

void cut(CutSide& side, double squaredRadius, double last) noexcept
{
  const bool fromInside = side.first <= squaredRadius;
  const bool toInside = last <= squaredRadius;
  if (fromInside && toInside)
  {
    side.isIn = true;
    side.enter = 0.0;
    side.leave = 1.0;
    return;
  }
  const double root = side.along * side.along + side.squared * (squaredRadius - side.first);
  const bool passes = side.along < 0.0 && side.along > -side.squared && root > 0.0;
  side.isIn = fromInside || toInside || passes;
  if (side.isIn)
  {
    const double half = std::sqrt(std::max(0.0, root));
    const double perSquared = 1.0 / side.squared;
    side.enter = fromInside ? 0.0 : std::clamp((-side.along - half) * perSquared, 0.0, 1.0);
    side.leave = toInside ? 1.0 : std::clamp((half - side.along) * perSquared, side.enter, 1.0);
  }
}

} // namespace

CutTriangle::CutTriangle(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius) noexcept
  : corners{ facet.corners[0] - center, facet.corners[1] - center, facet.corners[2] - center }
  , q{ corners[0].squaredNorm(), corners[1].squaredNorm(), corners[2].squaredNorm() }
{
  const double height = facet.normal.dot(corners[0]);
  disc = { facet.normal, height, squaredRadius - height * height };
}

bool CutTriangle::cutSides(double squaredRadius) noexcept
{
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Eigen::Vector3d& from = corners[k];
    CutSide& one = sides[k];
    one.vector = corners[kNext[k]] - from;
    one.squared = one.vector.squaredNorm();
    one.first = q[k];
    one.along = from.dot(one.vector);
    one.cross = tripleProduct(disc.normal, from, one.vector);
    if (one.cross < 0.0 && one.cross * one.cross >= disc.squared * one.squared)
    {
      return false; // the whole disc lies beyond this side
    }
    longest = std::max(longest, one.squared);
    cut(one, squaredRadius, q[kNext[k]]);
  }
  isStraight = disc.squared > kStraight * longest;
  return disc.squared > 0.0;
}

} // namespace palp
