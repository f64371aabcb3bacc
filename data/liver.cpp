#include "data/liver.h"

#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

struct Ellipsoid
{
  Vector3d center;   // [m]
  Vector3d semiAxes; // [m]
  double roll = 0.0; // about y [rad], right-handed
};

struct Capsule
{
  Vector3d from;
  Vector3d to;
  double fromRadius;
  double toRadius;
};

// first-order distance: exact on the surface, with a gradient near one around it
double distance(const Ellipsoid& e, const Vector3d& p) noexcept
{
  const Vector3d q = Eigen::AngleAxisd(-e.roll, Vector3d::UnitY()) * (p - e.center);
  const double level = q.cwiseQuotient(e.semiAxes).norm();
  const double slope = q.cwiseQuotient(e.semiAxes.cwiseAbs2()).norm();
  return slope > 0.0 ? level * (level - 1.0) / slope : -e.semiAxes.minCoeff();
}

double distance(const Capsule& c, const Vector3d& p) noexcept
{
  const Vector3d axis = c.to - c.from;
  const double t = std::clamp((p - c.from).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (p - c.from - t * axis).norm() - std::lerp(c.fromRadius, c.toRadius, t);
}

// union whose crease is filled over a width [m]; the cubic keeps it twice differentiable
double unite(double a, double b, double width) noexcept
{
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * h * width / 6.0;
}

double intersect(double a, double b, double width) noexcept
{
  return -unite(-a, -b, width);
}

double subtract(double a, double b, double width) noexcept
{
  return intersect(a, -b, width);
}

double smoothStep(double from, double to, double x) noexcept
{
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Vector3d mm(double x, double y, double z)
{
  return { units::fromMillimeters(x), units::fromMillimeters(y), units::fromMillimeters(z) };
}

const Ellipsoid kRightLobe{ mm(-39, 3, -24), mm(77, 46, 104), 0.14 };
const Ellipsoid kLeftLobe{ mm(32, -15, 12), mm(88, 26, 58), -0.16 };
const Ellipsoid kCaudate{ mm(4, 20, 18), mm(18, 15, 26) };

const Ellipsoid kStomach{ mm(84, 28, -50), mm(116, 73, 92), -0.45 };
const Ellipsoid kKidney{ mm(-54, 48, -78), mm(46, 56, 70) };
const Capsule kGallbladder{ mm(-30, -38, -76), mm(-8, 10, -20), 15.0_mm, 7.0_mm };
const Capsule kRoundLigament{ mm(11, -44, -50), mm(14, 10, 0), 5.0_mm, 5.0_mm };
const Capsule kPorta{ mm(-12, 12, -14), mm(16, 14, 6), 9.0_mm, 7.0_mm };
const Capsule kVenaCava{ mm(-14, 54, -60), mm(-8, 48, 90), 14.0_mm, 14.0_mm };

} // namespace

double liverDistance(const Vector3d& p) noexcept
{
  double d = unite(distance(kRightLobe, p), distance(kLeftLobe, p), 45.0_mm);

  // the visceral face looks down, back and to the left; its front edge is sharp, its back round
  const Vector3d down = Vector3d(0.55, 0.85, -1.0).normalized();
  const double visceral = (p - mm(0, -32, -48)).dot(down);
  const double edge = std::lerp(14.0_mm, 30.0_mm, smoothStep(-30.0_mm, 20.0_mm, p.y()));
  d = intersect(d, visceral, edge);
  d = unite(d, distance(kCaudate, p), 12.0_mm);

  d = subtract(d, distance(kStomach, p), edge);
  d = subtract(d, distance(kKidney, p), 20.0_mm);
  d = subtract(d, distance(kGallbladder, p), 12.0_mm);
  d = subtract(d, distance(kRoundLigament, p), 12.0_mm);
  d = subtract(d, distance(kPorta, p), 16.0_mm);
  d = subtract(d, distance(kVenaCava, p), 12.0_mm);

  // the falciform ligament draws a shallow furrow over the front, from its notch upwards
  const double aside = (p.x() - 8.0_mm + 0.06 * p.z()) / 5.0_mm;
  return d + 1.8_mm * std::exp(-aside * aside) * smoothStep(-5.0_mm, -25.0_mm, p.y());
}

} // namespace palp
