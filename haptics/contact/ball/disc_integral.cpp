#include "haptics/contact/ball/disc_integral.h"

#include "haptics/contact/ball/cut_triangle.h"
#include "haptics/numerics/angle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kOneThird = 1.0 / 3.0;

// area and weight of the part with w > 0 of a triangle over which w is as good as linear
DiscIntegral integratePositive(double area, const Eigen::Array3d& w) noexcept
{
  const auto positive = (w > 0.0).count();
  if (positive == 0)
  {
    return {};
  }
  if (positive > 1) // all less what is negative
  {
    const DiscIntegral rest = integratePositive(area, -w);
    return {
      .area = area - rest.area, .weight = area * kOneThird * w.sum() + rest.weight, .rim = rest.rim
    };
  }
  const double top = w.maxCoeff();
  const double reached = area * (top / (top - w)).min(1.0).prod();
  return { .area = reached, .weight = reached * top * kOneThird, .rim = 2.0 * reached / top };
}

DiscIntegral integrateWhole(const CutTriangle& one, double squaredRadius) noexcept
{
  const double area = one.area();
  const Eigen::Vector3d corners = one.corners[0] + one.corners[1] + one.corners[2];
  return { .area = area,
    .weight =
      area * (squaredRadius - (one.q[0] + one.q[1] + one.q[2] + corners.squaredNorm()) / 12.0),
    .slope = 2.0 * kOneThird * area * corners };
}

// of all arcs; below 0: the disc is beyond a corner
double turnOf(const CutTriangle& one, RimAngle& rim) noexcept
{
  // as complex numbers: one arctangent, known up to a full turn
  double cosine = 1.0;
  double sine = 0.0;
  int arcs = 0;
  const double scale = 1.0 / one.disc.squared;
  one.eachArc(
    [&](const Arc& arc)
    {
      rim.add(arc, one.disc);
      const double turned = (cosine * arc.cosine - sine * arc.sine) * scale;
      sine = (cosine * arc.sine + sine * arc.cosine) * scale;
      cosine = turned;
      ++arcs;
    });
  const auto& [first, second, third] = one.sides;
  const bool middleInside = first.cross > 0.0 && second.cross > 0.0 && third.cross > 0.0;
  const double turn = angleOf(sine, cosine);
  if (arcs == 0)
  {
    return middleInside ? 2.0 * std::numbers::pi : -1.0; // the whole disc, or nothing of it
  }
  if (middleInside)
  {
    return turn < -RimAngle::kRounding ? turn + 2.0 * std::numbers::pi : turn;
  }
  // from a middle upon a side half of the disc is seen, and rounding says in which sense
  return turn < -0.5 * std::numbers::pi ? turn + 2.0 * std::numbers::pi : std::max(0.0, turn);
}

// By Gauss's theorem the slope is one of w over the straight pieces of the boundary: on the arcs
// it is 0.
DiscIntegral integratePart(const CutTriangle& one, double squaredRadius, RimAngle& rim) noexcept
{
  const double turn = turnOf(one, rim);
  if (turn < 0.0)
  {
    return {};
  }
  rim.turn(turn, one.disc);
  const auto& [normal, height, disc] = one.disc;
  DiscIntegral sum;
  Eigen::Vector3d straight = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k)
  {
    const CutSide& side = one.sides[k];
    if (side.isIn)
    {
      const double length = side.length();
      const double within = squaredRadius * length - side.squares(); // of w
      straight += within * side.vector;
      sum.area += 0.5 * side.cross * length;
      sum.weight += 0.25 * side.cross * (disc * length + within);
    }
  }
  if (one.isStraight)
  {
    sum = integratePositive(one.area(), squaredRadius - Eigen::Array3d::Map(one.q.data()));
  }
  else
  {
    sum.rim = 0.5 * turn;
    sum.area += sum.rim * disc;
    sum.weight += 0.5 * sum.rim * disc * disc;
  }
  sum.slope = 2.0 * sum.area * height * normal - straight.cross(normal);
  return sum;
}

// of q^-1.5 over what is left of a side
double inverseCubes(const CutSide& side, double across) noexcept
{
  const auto until = [&](double part)
  { return (side.squared * part + side.along) / std::sqrt(side.squaredAt(part)); };
  return (until(side.leave) - until(side.enter)) /
    std::max(across, std::numeric_limits<double>::min());
}

} // namespace

DiscIntegral integrate(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius, RimAngle& rim) noexcept
{
  CutTriangle one(facet, center, squaredRadius);
  if (!(one.disc.squared > 0.0))
  {
    return {};
  }
  if (one.isWhole(squaredRadius))
  {
    return integrateWhole(one, squaredRadius);
  }
  return one.cutSides(squaredRadius) ? integratePart(one, squaredRadius, rim) : DiscIntegral{};
}

double solidAngleOf(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius) noexcept
{
  CutTriangle one(facet, center, squaredRadius);
  const double height = std::abs(one.disc.height);
  if (!(one.disc.squared > 0.0))
  {
    return 0.0;
  }
  if (one.isWhole(squaredRadius))
  {
    const auto& p = one.corners;
    const Eigen::Array3d r = Eigen::Array3d::Map(one.q.data()).sqrt();
    const Eigen::Array3d dots(p[1].dot(p[2]), p[2].dot(p[0]), p[0].dot(p[1]));
    return 2.0 * angleOf(2.0 * one.area() * height, r.prod() + (dots * r).sum());
  }
  const double radius = std::sqrt(squaredRadius);
  RimAngle unused(radius);
  const DiscIntegral part =
    one.cutSides(squaredRadius) ? integratePart(one, squaredRadius, unused) : DiscIntegral{};
  if (!(part.area > 0.0))
  {
    return 0.0;
  }
  if (one.isStraight)
  {
    const double squared = squaredRadius - part.weight / part.area;
    return height * part.area / (squared * std::sqrt(squared));
  }
  // the arcs' sectors, and a fan to the straight pieces from where the normal goes through the ball
  double cosine = 1.0;
  double sine = 0.0;
  for (const CutSide& side : one.sides)
  {
    if (side.isIn)
    {
      const double begin = side.squaredAt(side.enter);
      const double end = side.squaredAt(side.leave);
      const double length = side.length();
      const double dot = 0.5 * (begin + end - length * length * side.squared) - height * height;
      const double stepCosine = (std::sqrt(begin) + height) * (std::sqrt(end) + height) + dot;
      const double stepSine = side.cross * length;
      const double turned = cosine * stepCosine - sine * stepSine;
      sine = cosine * stepSine + sine * stepCosine;
      cosine = turned;
    }
  }
  // known up to two full turns, and at most one: what is a little below 0 is so by rounding
  const double seen = 2.0 * angleOf(sine, cosine) + 2.0 * part.rim * (1.0 - height / radius);
  return seen < -std::numbers::pi ? seen + 4.0 * std::numbers::pi : std::max(0.0, seen);
}

// By Stokes's theorem, of the radial fields whose divergence is w and 1 and which vanish on the
// ball: x (Q / 3 - q / 5 - 2 Q^2.5 / 15 q^1.5), and its slope over Q, x (1 - (Q / q)^1.5) / 3.
SeamIntegral seamsOf(const Facet& facet, const Eigen::Vector3d& center, double squaredRadius,
  std::uint8_t sides) noexcept
{
  const double cubed = squaredRadius * std::sqrt(squaredRadius);
  CutTriangle one(facet, center, squaredRadius);
  const bool reaches = one.cutSides(squaredRadius);
  SeamIntegral seams;
  for (std::size_t k = 0; reaches && k < 3; ++k)
  {
    const CutSide& side = one.sides[k];
    if (side.isIn && side.length() > 0.0 && (sides >> k & 1U) != 0)
    {
      const double length = side.length();
      const Eigen::Vector3d across = one.corners[k].cross(side.vector);
      const double nearer = cubed * inverseCubes(side, across.squaredNorm());
      seams.moment += (kOneThird * squaredRadius * length - 0.2 * side.squares() -
                        2.0 / 15.0 * squaredRadius * nearer) *
        across;
      seams.volume += kOneThird * (length - nearer) * across;
      seams.rim -= 0.5 * nearer / squaredRadius * across;
    }
  }
  return seams;
}

} // namespace palp
