#include "haptics/contact/disc_integral.h"

#include "haptics/numerics/angle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

// of the disc's squared radius over the squared side from which on its rim is straight, and sectors
// so much larger than their difference that rounding would be all of it
constexpr double kStraight = 1e4;
constexpr double kOneThird = 1.0 / 3.0;

// The integral of w over a triangle within the ball, given w at its corners and the squared sides:
// with barycentric coordinates l, w = sum of l_i w_i and of l_i l_j times the square of side ij.
double integrateInside(double area, double sumW, double sumSides) noexcept
{
  return area * kOneThird * (sumW + 0.25 * sumSides);
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
    const DiscIntegral rest = integratePositive(area, -w);
    return { .area = area - rest.area,
      .weight = integrateInside(area, w.sum(), 0.0) + rest.weight,
      .rim = rest.rim };
  }
  const double top = w.maxCoeff();
  const double reached = area * (top / (top - w)).min(1.0).prod();
  return { .area = reached, .weight = reached * top / 3.0, .rim = 2.0 * reached / top };
}

// from a place within reach of all of it, given its corners from there and their squared distances
DiscIntegral integrateWhole(const std::array<Eigen::Vector3d, 3>& p, const Eigen::Vector3d& normal,
  const Eigen::Array3d& q, double squaredRadius) noexcept
{
  const double area = 0.5 * normal.dot((p[1] - p[0]).cross(p[2] - p[0]));
  const Eigen::Array3d r = q.sqrt();
  const Eigen::Array3d dots(p[1].dot(p[2]), p[2].dot(p[0]), p[0].dot(p[1]));
  const double sumQ = q.sum();
  const double volume = 2.0 * area * std::abs(normal.dot(p[0]));
  return { .area = area,
    .weight = integrateInside(area, 3.0 * squaredRadius - sumQ, 2.0 * (sumQ - dots.sum())),
    .solidAngle = 2.0 * angleOf(volume, r.prod() + (dots * r).sum()) };
}

// A place in the plane of a triangle.
struct Place
{
  double squared;  // distance to the middle of the disc that the ball cuts from the plane
  double distance; // to the center of the ball
};

// One side of a triangle, seen from the middle of the disc.
struct Side
{
  Place from;
  Place to;
  double squared; // length
  double cross;   // of the two places, along the normal

  [[nodiscard]] double dot() const noexcept
  {
    return 0.5 * (from.squared + to.squared - squared);
  }
};

// what the boundary of triangle and disc adds up to: straight pieces, and the turn of the arcs
class Boundary
{
public:
  // squaredRadius: of the disc, whose plane has a height over the center of the ball; ball: its
  // radius
  Boundary(double squaredRadius, double height, double ball) noexcept
    : squaredRadius_(squaredRadius)
    , scale_(1.0 / squaredRadius)
    , height_(height)
    , ball_(ball)
  {
  }

  void add(const Side& side) noexcept
  {
    const bool fromInside = side.from.squared <= squaredRadius_;
    const bool toInside = side.to.squared <= squaredRadius_;
    if (fromInside && toInside)
    {
      line(side, 1.0, side.from, side.to);
      return;
    }
    const double along = side.dot() - side.from.squared;
    const double root = side.squared * squaredRadius_ - side.cross * side.cross;
    const bool passes = along < 0.0 && along > -side.squared && root > 0.0;
    if (!fromInside && !toInside && !passes)
    {
      arc(side.dot(), side.cross);
      return;
    }
    const double half = std::sqrt(std::max(0.0, root));
    const double perSquared = 1.0 / side.squared;
    double length = 1.0;
    if (!fromInside)
    {
      const double enter = (-along - half) * perSquared;
      arc(side.from.squared + enter * along, enter * side.cross);
      length -= enter;
    }
    if (!toInside)
    {
      const double rest = (side.squared + along - half) * perSquared;
      arc(side.to.squared - rest * (along + side.squared), rest * side.cross);
      length -= rest;
    }
    const Place rim{ squaredRadius_, ball_ };
    line(side, length, fromInside ? side.from : rim, toInside ? side.to : rim);
  }

  [[nodiscard]] DiscIntegral close(bool middleInside) const noexcept
  {
    if (!crossed_ && !middleInside)
    {
      return {}; // beyond a corner
    }
    // the turns were multiplied as complex numbers: one arctangent, known up to a full turn
    double turn = sine_ == 0.0 && cosine_ > 0.0 ? 0.0 : angleOf(sine_, cosine_);
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
    const double sector = turn * squaredRadius_;
    // known up to two full turns, and at most one: what is a little below 0 is so by rounding
    double seen = 2.0 * angleOf(seenSine_, seenCosine_) + turn * (1.0 - height_ / ball_);
    seen = seen < -std::numbers::pi ? seen + 4.0 * std::numbers::pi : std::max(0.0, seen);
    return { .area = area_ + 0.5 * sector,
      .weight = weight_ + 0.25 * sector * squaredRadius_,
      .rim = 0.5 * turn,
      .solidAngle = seen };
  }

private:
  static constexpr double kRounding = 1e-9; // [rad]

  // the triangle from the middle to a part of a side
  void line(const Side& side, double part, const Place& from, const Place& to) noexcept
  {
    const double begin = from.squared;
    const double end = to.squared;
    const double cross = side.cross * part;
    const double squared = part * part * side.squared;
    area_ += 0.5 * cross;
    weight_ +=
      integrateInside(0.5 * cross, 3.0 * squaredRadius_ - begin - end, squared + begin + end);
    const double cosine =
      (from.distance + height_) * (to.distance + height_) + 0.5 * (begin + end - squared);
    const double turned = seenCosine_ * cosine - seenSine_ * cross;
    seenSine_ = seenCosine_ * cross + seenSine_ * cosine;
    seenCosine_ = turned;
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
  double height_;
  double ball_;
  double area_ = 0.0;
  double weight_ = 0.0;
  double seenCosine_ = 1.0;
  double seenSine_ = 0.0;
  double cosine_ = 1.0;
  double sine_ = 0.0;
  bool crossed_ = false;
};

// The part of one side of a triangle within a ball, seen from its center.
struct Chord
{
  Eigen::Vector3d from; // the side's first corner [m]
  Eigen::Vector3d side; // [m]
  double first;         // q there [m^2]
  double along;         // of from and side [m^2]
  double squared;       // length of the side [m^2]
  double enter = 0.0;   // parts of the side
  double leave = 0.0;

  Chord(
    const Facet& facet, std::size_t k, const Eigen::Vector3d& center, double squaredRadius) noexcept
    : from(facet.corners[k] - center)
    , side(facet.corners[(k + 1) % 3] - facet.corners[k])
    , first(from.squaredNorm())
    , along(from.dot(side))
    , squared(side.squaredNorm())
  {
    const double root = along * along + squared * (squaredRadius - first);
    if (root > 0.0)
    {
      const double half = std::sqrt(root);
      enter = std::max(0.0, (-along - half) / squared);
      leave = std::max(enter, std::min(1.0, (half - along) / squared));
    }
  }

  // integrals over it, whose whole side has the length 1: of 1, of q and of q^-1.5
  [[nodiscard]] double length() const noexcept
  {
    return leave - enter;
  }
  [[nodiscard]] double squares() const noexcept
  {
    return length() *
      (first + along * (enter + leave) +
        kOneThird * squared * (enter * enter + enter * leave + leave * leave));
  }
  // across: of from and side, squared
  [[nodiscard]] double inverseCubes(double across) const noexcept
  {
    const auto until = [this](double part)
    { return (squared * part + along) / std::sqrt(first + part * (2.0 * along + part * squared)); };
    return (until(leave) - until(enter)) / std::max(across, std::numeric_limits<double>::min());
  }
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
  const Eigen::Array3d q(p[0].squaredNorm(), p[1].squaredNorm(), p[2].squaredNorm());
  if (q.maxCoeff() <= squaredRadius)
  {
    return integrateWhole(p, facet.normal, q, squaredRadius);
  }
  // from each corner to the next
  const std::array<double, 3> sides = { (p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(),
    (p[0] - p[2]).squaredNorm() };
  if (disc > kStraight * std::max({ sides[0], sides[1], sides[2] }))
  {
    const double area = 0.5 * facet.normal.dot((p[1] - p[0]).cross(p[2] - p[0]));
    DiscIntegral part = integratePositive(area, squaredRadius - q);
    const double squared = squaredRadius - (part.area > 0.0 ? part.weight / part.area : 0.0);
    part.solidAngle = std::abs(height) * part.area / (squared * std::sqrt(squared));
    return part;
  }
  const std::array<double, 3> crosses = { facet.normal.dot(p[0].cross(p[1])),
    facet.normal.dot(p[1].cross(p[2])), facet.normal.dot(p[2].cross(p[0])) };
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (crosses[k] < 0.0 && crosses[k] * crosses[k] >= disc * sides[k])
    {
      return {}; // the whole disc lies beyond this side
    }
  }
  const Eigen::Array3d r = q.sqrt();
  Boundary boundary(disc, std::abs(height), std::sqrt(squaredRadius));
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto from = static_cast<Eigen::Index>(k);
    const Eigen::Index to = (from + 1) % 3;
    boundary.add({ .from = { q[from] - height * height, r[from] },
      .to = { q[to] - height * height, r[to] },
      .squared = sides[k],
      .cross = crosses[k] });
  }
  return boundary.close(crosses[0] > 0.0 && crosses[1] > 0.0 && crosses[2] > 0.0);
}

// By Gauss's theorem, of w over the straight pieces of the boundary: on the arcs it is 0.
Eigen::Vector3d weightSlope(const Facet& facet, const Eigen::Vector3d& center, double squaredRadius,
  const DiscIntegral& inside) noexcept
{
  const auto& [a, b, c] = facet.corners;
  const auto isIn = [&](const auto& x) { return (x - center).squaredNorm() <= squaredRadius; };
  if (isIn(a) && isIn(b) && isIn(c))
  {
    return 2.0 * inside.area * (kOneThird * (a + b + c) - center);
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Chord chord(facet, k, center, squaredRadius);
    sum += (chord.length() * squaredRadius - chord.squares()) * chord.side;
  }
  return 2.0 * inside.area * facet.normal.dot(a - center) * facet.normal - sum.cross(facet.normal);
}

// By Stokes's theorem, of the radial fields whose divergence is w and 1 and which vanish on the
// ball: x (Q / 3 - q / 5 - 2 Q^2.5 / 15 q^1.5), and its slope over Q, x (1 - (Q / q)^1.5) / 3.
SeamIntegral seamsOf(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius) noexcept
{
  const double cubed = squaredRadius * std::sqrt(squaredRadius);
  SeamIntegral seams;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Chord chord(facet, k, center, squaredRadius);
    const double length = chord.length();
    if (length > 0.0)
    {
      const Eigen::Vector3d across = chord.from.cross(chord.side);
      const double nearer = cubed * chord.inverseCubes(across.squaredNorm());
      seams.moment += (kOneThird * squaredRadius * length - 0.2 * chord.squares() -
                        2.0 / 15.0 * squaredRadius * nearer) *
        across;
      seams.volume += kOneThird * (length - nearer) * across;
    }
  }
  return seams;
}

} // namespace palp
