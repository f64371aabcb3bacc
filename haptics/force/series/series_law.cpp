#include "haptics/force/series/series_law.h"

#include "haptics/force/linear/half_space.h"
#include "haptics/numerics/roots.h"
#include "haptics/tip/tip.h"

#include <vector>

namespace palp
{
namespace
{

constexpr int kIntervals = 96;
constexpr double kDeepest = 3.0;        // of the base radius, for the tables
constexpr double kWidened = 4.0 / 15.0; // of a pressure as that of a paraboloid

// grows with x
double pullOf(double x, double edge) noexcept
{
  const double far = 1.0 + edge * x;
  return x * far * far;
}

// x of a pull that is 0 or more
double asideOf(double pull, double edge) noexcept
{
  if (!(edge > 0.0))
  {
    return pull;
  }
  // y (1 + y)^2 = p: from 19 % above at most, by Halley to 1e-7
  const double p = edge * pull;
  double y = p < 1.0 ? p * (1.0 + 1.5 * p) / (1.0 + 3.5 * p) : std::cbrt(p) - 0.5;
  for (int i = 0; i < 2; ++i)
  {
    const double value = y * (1.0 + y) * (1.0 + y) - p;
    const double slope = (1.0 + y) * (1.0 + 3.0 * y);
    y -= value * slope / (slope * slope - value * (2.0 + 3.0 * y));
  }
  return y / edge;
}

double roundnessOf(const Tip& tip)
{
  const auto* sphere = std::get_if<SphereTip>(&tip);
  const auto* paraboloid = std::get_if<ParaboloidTip>(&tip);
  return sphere ? sphere->radius : paraboloid ? paraboloid->radius : 0.0;
}

// radii of a half-space's contact at equal steps of the cube root of the force
std::vector<double> radiiOf(const HalfSpace& contact, double last, double deepest)
{
  std::vector<double> radii{ contact(1e-9 * deepest).radius };
  for (int i = 1; i <= kIntervals; ++i)
  {
    const double root = last * i / kIntervals;
    constexpr int kHalvings = 60;
    const RootBracket depth =
      bisect([&](double at) { return contact(at).force < root * root * root; }, { 0.0, deepest },
        kHalvings);
    radii.push_back(contact(depth.high).radius);
  }
  return radii;
}

// int a^2 f df by the cube root of the force, up to each step
std::vector<double> widenedOf(const CubicSpline& radii, const SplineAxis& axis)
{
  constexpr std::array kNodes{ 0.1127016653792583, 0.5, 0.8872983346207417 };
  constexpr std::array kWeights{ 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0 };
  std::vector<double> sums{ 0.0 };
  for (int i = 0; i < kIntervals; ++i)
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < kNodes.size(); ++k)
    {
      const double root = axis.step() * (i + kNodes[k]);
      sum += kWeights[k] * std::pow(radii(root).value, 2) * 3.0 * std::pow(root, 5);
    }
    sums.push_back(sums.back() + axis.step() * sum);
  }
  return sums;
}

} // namespace

SeriesLaw::SeriesLaw(const Tip& tip, double modulus)
  : modulus_(modulus)
  , isSphere_(std::holds_alternative<SphereTip>(tip))
  , round_(roundnessOf(tip))
  , axis_{ 0.0, 1.0, kIntervals }
{
  const HalfSpace contact(tip);
  const double deepest = kDeepest * baseRadius(tip);
  axis_.last = std::cbrt(contact(deepest).force);
  radii_.emplace(axis_, radiiOf(contact, axis_.last, deepest));
  widened_.emplace(axis_, widenedOf(*radii_, axis_));
}

SeriesLaw::Radius SeriesLaw::radiusOf(double force) const noexcept
{
  return radiusAt(std::cbrt(std::max(0.0, force)));
}

SeriesLaw::Radius SeriesLaw::radiusAt(double root) const noexcept
{
  const CubicSpline::Value radius = (*radii_)(root);
  return { radius.value,
    root > 0.0 && root < axis_.last ? radius.slope / (3.0 * root * root) : 0.0 };
}

double SeriesLaw::widenedAt(double root, double radius) const noexcept
{
  // beyond the tables as wide as where they end
  const double cube = root * root * root;
  const double last = axis_.last * axis_.last * axis_.last;
  const double beyond = std::max(0.0, cube * cube - last * last);
  return (*widened_)(root).value + 0.5 * radius * radius * beyond;
}

SeriesLaw::Yield SeriesLaw::yieldOf(double force, const BodyCompliance& body) const noexcept
{
  const Radius width = radiusOf(force);
  const double a = width.value;
  const double widened = kWidened * body.bend * a;
  Yield yield{ .depth = force * (body.constant + widened * a),
    .slope = body.constant + widened * (a + 2.0 * force * width.slope) };
  if (!(body.slope > 0.0 && force > 0.0))
  {
    return yield;
  }
  const auto [x, far, nearer, less, power, wider, isHeld] = gainOf(force, width, body);
  // of f^2 nearer and f^2 less, as powers of the force
  const double more = nearer * wider / far;
  const double falling = 2.0 + 2.0 * wider - power;
  yield.depth -= force * (2.0 * nearer + more - falling * less);
  if (isHeld)
  {
    yield.slope -=
      2.0 * nearer + more * (3.0 + wider * (2.0 / far - 1.0)) - falling * (falling - 1.0) * less;
    return yield;
  }
  // x grows as q b does
  const double with = power * nearer / (3.0 * far - 2.0);
  yield.slope -= 2.0 * (nearer + with) - falling * (with + (1.0 - power) * less);
  return yield;
}

// the contact as a power of the depth, and what the body gives as one of the force, which they
// nearly are
double SeriesLaw::start(const Response& first, const Yield& most, double depth) const noexcept
{
  const double force = first.force / modulus_;
  if (!(force > 0.0))
  {
    return depth;
  }
  const double power = std::clamp(first.stiffness * depth / first.force, 1.0, 3.0) *
    std::clamp(most.slope * force / most.depth, 0.25, 2.0);
  const double given = most.depth / depth;
  // y + given y^power = 1
  const double y = 1.0 / (1.0 + given);
  const double yields = given * std::pow(y, power);
  return depth * std::max(0.1 * y, y - (y + yields - 1.0) / (1.0 + power * yields / y));
}

SeriesLaw::Gain SeriesLaw::gainOf(
  double force, const Radius& width, const BodyCompliance& body) const noexcept
{
  const double a = width.value;
  const double wider = force * width.slope / a; // a as a power of the force
  const double q = isSphere_ ? round_ * force : 4.0 / 3.0 * a * a * a;
  const double pull = q * body.slope;
  const double most = 0.5 * a;
  const bool isHeld = pullOf(most, body.edge) < pull;
  const double x = isHeld ? most : asideOf(pull, body.edge);
  const double far = 1.0 + body.edge * x;
  return { .aside = x,
    .far = far,
    .nearer = body.slope * x / far,
    .less = 0.5 * x * x / q,
    .power = isSphere_ ? 1.0 : 3.0 * wider,
    .wider = isHeld ? wider : 0.0,
    .isHeld = isHeld };
}

double SeriesLaw::aside(const BodyCompliance& body, double force) const noexcept
{
  const double f = force / modulus_;
  const Radius width = radiusOf(f);
  return f > 0.0 ? gainOf(f, width, body).aside / width.value : 0.0;
}

SeriesLaw::Loaded SeriesLaw::load(const BodyCompliance& body, double force) const noexcept
{
  const double f = force / modulus_;
  const double root = std::cbrt(std::max(0.0, f));
  const Radius width = radiusAt(root);
  Loaded load{ f, widenedAt(root, width.value), 0.0, 0.0 };
  if (body.slope > 0.0 && f > 0.0)
  {
    const Gain gain = gainOf(f, width, body);
    load.aside = gain.aside;
    load.less = gain.less;
  }
  return load;
}

double SeriesLaw::energy(const BodyCompliance& body, const Loaded& load) const noexcept
{
  return modulus_ * (energyOf(load, body) + load.force * load.force * load.less);
}

// x is where the gain is most, so that its own change does not count
Eigen::Vector3d SeriesLaw::lateral(const BodyCompliance& here,
  const std::array<BodyCompliance, 3>& aside, double step, const Loaded& load) const noexcept
{
  const double energy = energyOf(load, here);
  const auto slope = [&](const BodyCompliance& body)
  { return modulus_ * (energyOf(load, body) - energy) / step; };
  return { slope(aside[0]), slope(aside[1]), slope(aside[2]) };
}

double SeriesLaw::energyOf(const Loaded& load, const BodyCompliance& body) noexcept
{
  const auto& [f, widened, x, less] = load;
  return f * f * (0.5 * body.constant - body.slope * x / (1.0 + body.edge * x)) +
    kWidened * widened * body.bend;
}

} // namespace palp
