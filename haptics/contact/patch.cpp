#include "haptics/contact/patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

// of the disc's squared radius over the squared side from which on its rim is straight, and sectors
// so much larger than their difference that rounding would be all of it
constexpr double kStraight = 1e4;

// A triangle within the ball, given w at its corners and the squared sides opposite to them: with
// barycentric coordinates l, w = sum of l_i w_i and of l_i l_j times the square of side ij.
DiscIntegral integrateInside(
  double area, const Eigen::Array3d& w, const Eigen::Array3d& sides) noexcept
{
  const double sumW = w.sum();
  const double sumSides = sides.sum();
  const double squares = (w * w).sum() + sumW * sumW;
  const double mixed = 2.0 * sumW * sumSides - (sides * w).sum();
  const double bulge = sumSides * sumSides + (sides * sides).sum();
  return { .weight = area * (sumW / 3.0 + sumSides / 12.0),
    .square = area * (squares / 12.0 + mixed / 30.0 + bulge / 180.0) };
}

// The part with w > 0 of a triangle over which w is as good as linear.
DiscIntegral integratePositive(double area, const Eigen::Array3d& w) noexcept
{
  const auto positive = (w > 0.0).count();
  if (positive == 0)
  {
    return {};
  }
  if (positive > 1) // all less what is negative
  {
    const DiscIntegral all = integrateInside(area, w, Eigen::Array3d::Zero());
    const DiscIntegral rest = integratePositive(area, -w);
    return { .weight = all.weight + rest.weight, .square = all.square - rest.square };
  }
  const double top = w.maxCoeff();
  const double reached = area * (top / (top - w)).min(1.0).prod();
  return { .weight = reached * top / 3.0, .square = reached * top * top / 6.0 };
}

// One side of a triangle, seen from the middle of the disc that the ball cuts from its plane.
struct Side
{
  double fromSquared; // squared distance of its first point to the middle
  double toSquared;   // of its second
  double squared;     // squared length
  double cross;       // of the two points, along the normal

  [[nodiscard]] double dot() const noexcept
  {
    return 0.5 * (fromSquared + toSquared - squared);
  }
};

// what the boundary of triangle and disc adds up to: straight pieces, and the turn of the arcs
class Boundary
{
public:
  explicit Boundary(double squaredRadius) noexcept
    : squaredRadius_(squaredRadius)
    , scale_(1.0 / squaredRadius)
  {
  }

  void add(const Side& side) noexcept
  {
    const bool fromInside = side.fromSquared <= squaredRadius_;
    const bool toInside = side.toSquared <= squaredRadius_;
    if (fromInside && toInside)
    {
      line(side, 1.0, side.fromSquared, side.toSquared);
      return;
    }
    const double along = side.dot() - side.fromSquared;
    const double root = along * along - side.squared * (side.fromSquared - squaredRadius_);
    const bool passes = along < 0.0 && along > -side.squared && root > 0.0;
    if (!fromInside && !toInside && !passes)
    {
      arc(side.dot(), side.cross);
      return;
    }
    const double half = std::sqrt(std::max(0.0, root));
    double length = 1.0;
    if (!fromInside)
    {
      const double enter = (-along - half) / side.squared;
      arc(side.fromSquared + enter * along, enter * side.cross);
      length -= enter;
    }
    if (!toInside)
    {
      const double rest = (side.squared + along - half) / side.squared;
      arc(side.toSquared - rest * (along + side.squared), rest * side.cross);
      length -= rest;
    }
    line(side, length, fromInside ? side.fromSquared : squaredRadius_,
      toInside ? side.toSquared : squaredRadius_);
  }

  [[nodiscard]] DiscIntegral close(bool middleInside) const noexcept
  {
    // the turns were multiplied as complex numbers: one arctangent, known up to a full turn
    double turn = sine_ == 0.0 && cosine_ > 0.0 ? 0.0 : std::atan2(sine_, cosine_);
    if (!middleInside)
    {
      // from a middle upon a side half of the disc is seen, and rounding says in which sense
      turn = turn < -0.5 * std::numbers::pi ? turn + 2.0 * std::numbers::pi : std::max(0.0, turn);
    }
    else if (!crossed_)
    {
      turn = 2.0 * std::numbers::pi; // the whole disc
    }
    else if (turn < -kRounding)
    {
      turn += 2.0 * std::numbers::pi;
    }
    const double sector = turn * squaredRadius_ * squaredRadius_;
    return { .weight = weight_ + sector / 4.0, .square = square_ + sector * squaredRadius_ / 6.0 };
  }

private:
  static constexpr double kRounding = 1e-9; // [rad]

  // the triangle from the middle to a part of a side, given the squared distances of its ends
  void line(const Side& side, double part, double begin, double end) noexcept
  {
    const DiscIntegral triangle = integrateInside(0.5 * side.cross * part,
      { squaredRadius_, squaredRadius_ - begin, squaredRadius_ - end },
      { part * part * side.squared, end, begin });
    weight_ += triangle.weight;
    square_ += triangle.square;
    crossed_ = true;
  }

  // from one point to another, given their dot and cross products
  void arc(double dot, double cross) noexcept
  {
    const double cosine = (cosine_ * dot - sine_ * cross) * scale_;
    sine_ = (cosine_ * cross + sine_ * dot) * scale_;
    cosine_ = cosine;
  }

  double squaredRadius_;
  double scale_;
  double weight_ = 0.0;
  double square_ = 0.0;
  double cosine_ = 1.0;
  double sine_ = 0.0;
  bool crossed_ = false;
};

} // namespace

DiscIntegral integrate(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius) noexcept
{
  const std::array<Eigen::Vector3d, 3> p = { facet.corners[0] - center, facet.corners[1] - center,
    facet.corners[2] - center };
  const double height = facet.normal.dot(p[0]);
  const double disc = squaredRadius - height * height;
  if (!(disc > 0.0))
  {
    return {};
  }
  const std::array<double, 3> q = { p[0].squaredNorm(), p[1].squaredNorm(), p[2].squaredNorm() };
  const Eigen::Array3d w(squaredRadius - q[0], squaredRadius - q[1], squaredRadius - q[2]);
  const Eigen::Array3d sides(
    (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm(), (p[1] - p[0]).squaredNorm());
  const bool whole = w.minCoeff() >= 0.0;
  if (whole || disc > kStraight * sides.maxCoeff())
  {
    const double area = 0.5 * facet.normal.dot((p[1] - p[0]).cross(p[2] - p[0]));
    return whole ? integrateInside(area, w, sides) : integratePositive(area, w);
  }

  Boundary boundary(disc);
  bool middleInside = true;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t next = (k + 1) % 3;
    const Side side{ .fromSquared = q[k] - height * height,
      .toSquared = q[next] - height * height,
      .squared = sides[static_cast<Eigen::Index>((k + 2) % 3)],
      .cross = facet.normal.dot(p[k].cross(p[next])) };
    if (side.cross < 0.0 && side.cross * side.cross >= disc * side.squared)
    {
      return {}; // the whole disc lies beyond this side
    }
    boundary.add(side);
    middleInside = middleInside && side.cross > 0.0;
  }
  return boundary.close(middleInside);
}

Patch patchWithin(const Surface& surface, const Eigen::Vector3d& center, double radius, double side,
  double fade) noexcept
{
  Patch patch;
  const double squaredRadius = radius * radius;
  const BoxTree& tree = surface.tree();
  const auto near = [&](const BoxTree::Node& box)
  { return squaredDistance(box, center) < squaredRadius; };
  const auto add = [&](int i)
  {
    const Facet& facet = tree.facets()[static_cast<std::size_t>(i)];
    const DiscIntegral inside = integrate(facet, center, squaredRadius);
    if (!(inside.weight > 0.0))
    {
      return;
    }
    const double height = facet.normal.dot(center - facet.corners[0]);
    const double part = std::max(0.0, 1.0 + std::min(0.0, side * height) / fade);
    const Eigen::Vector3d normal = inside.weight * facet.normal;
    patch.weight += part * inside.weight;
    patch.normal += part * normal;
    patch.square += part * inside.square * facet.normal;
    patch.orientationSum += normal;
    patch.orientationWeight += inside.weight;
  };
  tree.search(near, add);
  return patch;
}

} // namespace palp
