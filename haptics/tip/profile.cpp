#include "haptics/tip/profile.h"

#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace palp
{
namespace
{

constexpr std::size_t kMaxPoints = 10'000; // bounds the time to bake a table
constexpr double kRounding = 1e-4;         // [-], slope that the rounding of a file may take back

using Point = Profile::Point;

double secant(const std::vector<Point>& p, std::size_t i)
{
  return (p[i + 1].height - p[i].height) / (p[i + 1].radius - p[i].radius);
}

// what is wrong with point i, given those before it
std::optional<std::string> fault(const std::vector<Point>& p, std::size_t i)
{
  if (!std::isfinite(p[i].radius) || !std::isfinite(p[i].height))
  {
    return "not finite; give numbers";
  }
  if (i == 0)
  {
    return p[0].radius == 0.0 && p[0].height == 0.0
      ? std::nullopt
      : std::optional<std::string>("not the apex; begin at radius 0 and height 0");
  }
  if (p[i].radius <= p[i - 1].radius)
  {
    return "the radius does not grow; sort the points from apex to base";
  }
  if (p[i].height < p[i - 1].height)
  {
    return "the height falls; give a convex tip, apex down";
  }
  if (i > 1 && secant(p, i - 1) < secant(p, i - 2) - kRounding)
  {
    return "the profile turns inward; give a convex tip";
  }
  return std::nullopt;
}

// slope at the end of p[i] of the parabola through p[i], p[j], p[k]
double parabolaSlope(const std::vector<Point>& p, std::size_t i, std::size_t j, std::size_t k)
{
  const double x = p[j].radius - p[i].radius;
  const double y = p[k].radius - p[i].radius;
  const double toJ = (p[j].height - p[i].height) / x;
  const double toK = (p[k].height - p[i].height) / y;
  return (toJ * y - toK * x) / (y - x);
}

// a corner: the two sides, each continued by itself, meet at clearly different slopes
bool isCorner(const std::vector<Point>& p, std::size_t i)
{
  const double before = i > 1 ? parabolaSlope(p, i, i - 1, i - 2) : secant(p, 0);
  const double after = i + 2 < p.size() ? parabolaSlope(p, i, i + 1, i + 2) : secant(p, i);
  const double turn = secant(p, i) - secant(p, i - 1);
  return turn > kRounding && after - before > 0.5 * turn;
}

// slope at a point that is no corner: the middle one of the parabolas before, around and after
// it, so that a jump of the curvature here spoils none of the neighboring pieces
double smoothSlope(const std::vector<Point>& p, const std::vector<char>& corner, std::size_t i)
{
  const double around = parabolaSlope(p, i, i - 1, i + 1);
  if (corner[i - 1] != 0 || corner[i + 1] != 0)
  {
    return around;
  }
  const double before = parabolaSlope(p, i, i - 1, i - 2);
  const double after = parabolaSlope(p, i, i + 1, i + 2);
  return std::max(std::min(before, after), std::min(std::max(before, after), around));
}

} // namespace

Profile Profile::read(const std::filesystem::path& file)
{
  const NumberTable table = NumberTable::read(file, "radius_mm,height_mm");
  std::vector<Point> points;
  for (const NumberTable::Row& row : table.rows)
  {
    points.push_back(
      { units::fromMillimeters(row.values[0]), units::fromMillimeters(row.values[1]) });
    if (const auto wrong = fault(points, points.size() - 1))
    {
      throw Error(ErrorCode::BadFile, where(file, row.line) + *wrong);
    }
  }
  try
  {
    return Profile(std::move(points), file.string());
  }
  catch (const Error& error)
  {
    // what only the whole file shows is told with its last line
    throw Error(ErrorCode::BadFile, where(file, table.lastLine) + error.what());
  }
}

Profile::Profile(std::vector<Point> points, std::string name)
  : name_(std::move(name))
{
  if (points.size() < 3 || points.size() > kMaxPoints)
  {
    throw Error(ErrorCode::BadValue,
      "profile: " + std::to_string(points.size()) + " points; give 3 to " +
        std::to_string(kMaxPoints));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (const auto wrong = fault(points, i))
    {
      throw Error(ErrorCode::BadValue, "profile point " + std::to_string(i + 1) + ": " + *wrong);
    }
  }

  const std::size_t last = points.size() - 1;
  std::vector<char> corner(points.size(), 1); // both ends count as corners
  for (std::size_t i = 1; i < last; ++i)
  {
    corner[i] = isCorner(points, i) ? 1 : 0;
  }
  for (std::size_t i = 0; i < last; ++i)
  {
    // slopes at both ends, from parabolas that do not reach across a corner
    const double chord = secant(points, i);
    double from = chord;
    double to = chord;
    if (corner[i] == 0)
    {
      from = smoothSlope(points, corner, i);
    }
    else if (corner[i + 1] == 0)
    {
      from = parabolaSlope(points, i, i + 1, i + 2);
    }
    if (corner[i + 1] == 0)
    {
      to = smoothSlope(points, corner, i + 1);
    }
    else if (corner[i] == 0)
    {
      to = parabolaSlope(points, i + 1, i, i - 1);
    }
    // never falling, and monotone: Fritsch and Carlson 1980
    from = std::clamp(from, 0.0, 3.0 * chord);
    to = std::clamp(to, 0.0, 3.0 * chord);

    const double x = points[i].radius;
    const double h = points[i + 1].radius - x;
    const double bend = 3.0 * (from + to - 2.0 * chord) / (h * h);
    const double turn = (to - from) / h - bend * h; // f' = from + turn t + bend t^2, t = r - x
    pieces_.push_back({ .begin = x,
      .end = points[i + 1].radius,
      .height = points[i].height,
      .c0 = from - turn * x + bend * x * x,
      .c1 = turn - 2.0 * bend * x,
      .c2 = bend });
  }
  bakeCircles();
}

void Profile::bakeCircles() noexcept
{
  for (std::size_t i = 0; i < kCircles; ++i)
  {
    circleDepths_[i] = contactDepth(circleRadius(flatRadius(), baseRadius(), i));
  }
}

const Profile::Piece& Profile::pieceAt(double radius) const noexcept
{
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), radius,
    [](double r, const Piece& piece) { return r < piece.end; });
  return after == pieces_.end() ? pieces_.back() : *after;
}

double Profile::height(double radius) const noexcept
{
  const double r = std::clamp(radius, 0.0, baseRadius());
  const Piece& piece = pieceAt(r);
  // Simpson's rule is exact for the quadratic slope
  const double middle = 0.5 * (piece.begin + r);
  return piece.height +
    (r - piece.begin) / 6.0 *
    (piece.slope(piece.begin) + 4.0 * piece.slope(middle) + piece.slope(r));
}

double Profile::slope(double radius) const noexcept
{
  const double r = std::clamp(radius, 0.0, baseRadius());
  return std::max(0.0, pieceAt(r).slope(r));
}

double Profile::noseRadius() const noexcept
{
  constexpr double kPointed = 0.1; // [-] of the slope at a quarter
  const double quarter = 0.25 * baseRadius();
  return flatRadius() > 0.0 || slope(0.0) > kPointed * slope(quarter) ? 0.0
                                                                      : quarter / slope(quarter);
}

double Profile::flatRadius() const noexcept
{
  double radius = 0.0;
  for (const Piece& piece : pieces_)
  {
    if (height(piece.end) > 0.0)
    {
      break;
    }
    radius = piece.end;
  }
  return radius;
}

double Profile::contactDepth(double radius) const noexcept
{
  // int r^k / sqrt(a^2 - r^2) dr for k = 0, 1, 2 in closed form, piece by piece
  const double a = std::clamp(radius, 0.0, baseRadius());
  double sum = 0.0;
  double angle = 0.0; // asin(r / a)
  double rest = a;    // sqrt(a^2 - r^2)
  for (const Piece& piece : pieces_)
  {
    if (piece.begin >= a)
    {
      break;
    }
    const double r = std::min(piece.end, a);
    const double nextAngle = r < a ? std::asin(r / a) : std::asin(1.0);
    const double nextRest = r < a ? std::sqrt((a - r) * (a + r)) : 0.0;
    const double second = 0.5 * (a * a * (nextAngle - angle) - (r * nextRest - piece.begin * rest));
    sum += piece.c0 * (nextAngle - angle) + piece.c1 * (rest - nextRest) + piece.c2 * second;
    angle = nextAngle;
    rest = nextRest;
  }
  return a * sum;
}

} // namespace palp
