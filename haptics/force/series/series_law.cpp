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

// int a^power f df by the cube root of the force, up to each step
std::vector<double> integralsOf(const CubicSpline& radii, const SplineAxis& axis, int power)
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
      sum += kWeights[k] * std::pow(radii(root).value, power) * 3.0 * std::pow(root, 5);
    }
    sums.push_back(sums.back() + axis.step() * sum);
  }
  return sums;
}

} // namespace

SeriesLaw::SeriesLaw(const ForceLaw& law)
  : modulus_(law.material().contactModulus())
  , round_(roundnessOf(law.tip()))
  , axis_{ 0.0, 1.0, kIntervals }
{
  const HalfSpace contact(law.tip());
  const double deepest = kDeepest * baseRadius(law.tip());
  axis_.last = std::cbrt(contact(deepest).force);
  radii_.emplace(axis_, radiiOf(contact, axis_.last, deepest));
  firsts_.emplace(axis_, integralsOf(*radii_, axis_, 1));
  seconds_.emplace(axis_, integralsOf(*radii_, axis_, 2));
}

SeriesLaw::Radius SeriesLaw::radiusOf(double force) const noexcept
{
  const double root = std::cbrt(std::max(0.0, force));
  const CubicSpline::Value radius = (*radii_)(root);
  return { radius.value,
    root > 0.0 && root < axis_.last ? radius.slope / (3.0 * root * root) : 0.0 };
}

SeriesLaw::Width SeriesLaw::widthOf(double force) const noexcept
{
  const double root = std::min(std::cbrt(std::max(0.0, force)), axis_.last);
  const double edge = root * root * root;
  const double radius = (*radii_)(root).value;
  const double more = 0.5 * (force * force - edge * edge); // beyond the tables it is as wide
  return { .radius = radius,
    .first = (*firsts_)(root).value + radius * more,
    .second = (*seconds_)(root).value + radius * radius * more };
}

SeriesLaw::Yield SeriesLaw::yieldOf(double force, const BodyCompliance& body) const noexcept
{
  const Radius width = radiusOf(force);
  const double a = width.value;
  const double widened = kWidened * body.bend * a;
  Yield yield{ .depth = force * (body.constant + widened * a),
    .slope = body.constant + widened * (a + 2.0 * force * width.slope) };
  if (!(round_ > 0.0))
  {
    return yield;
  }
  const double aside = round_ * body.slope * force;
  if (aside <= 0.5 * a)
  {
    yield.depth -= 1.5 * body.slope * aside * force;
    yield.slope -= 3.0 * body.slope * aside;
    return yield;
  }
  yield.depth += a * (0.125 * a / round_ - force * body.slope);
  yield.slope += 0.25 * a * width.slope / round_ - body.slope * (a + force * width.slope);
  return yield;
}

// the contact as a power of the depth, which it nearly is
double SeriesLaw::start(
  const Response& first, const BodyCompliance& body, double depth) const noexcept
{
  const double force = first.force / modulus_;
  if (!(force > 0.0))
  {
    return depth;
  }
  const double power = std::clamp(first.stiffness * depth / first.force, 1.0, 3.0);
  const double given = yieldOf(force, body).depth / depth;
  if (given < 0.0)
  {
    return depth;
  }
  // y + given y^power = 1
  double y = 1.0 / (1.0 + given);
  for (int i = 0; i < 2; ++i)
  {
    const double yields = given * std::pow(y, power);
    y = std::max(0.1 * y, y - (y + yields - 1.0) / (1.0 + power * yields / y));
  }
  return y * depth;
}

// from which on the pressure moves aside by no more than half of the contact's radius
double SeriesLaw::forceAtHold(double slope) const noexcept
{
  double root = axis_.last;
  for (int i = 0; i < 8; ++i)
  {
    root = std::min(
      axis_.last, std::sqrt(radiusOf(root * root * root).value / root / (2.0 * round_ * slope)));
  }
  return root * root * root;
}

Eigen::Vector3d SeriesLaw::lateral(const ComplianceField::Local& local, double force) const noexcept
{
  const double f = force / modulus_;
  const Width width = widthOf(f);
  Eigen::Vector3d sum = 0.5 * f * f * local.constant + kWidened * width.second * local.bend;
  if (round_ > 0.0)
  {
    const double slope = local.body.slope;
    double part = round_ * slope * f * f * f;
    if (round_ * slope * f > 0.5 * width.radius)
    {
      const double held = forceAtHold(slope);
      part = round_ * slope * held * held * held + width.first - widthOf(held).first;
    }
    sum -= part * local.slope;
  }
  return modulus_ * sum;
}

double SeriesLaw::energy(const BodyCompliance& body, double force) const noexcept
{
  const double f = force / modulus_;
  const Width width = widthOf(f);
  double sum = 0.5 * f * f * body.constant + kWidened * width.second * body.bend;
  if (round_ > 0.0 && body.slope > 0.0)
  {
    const double held = std::min(f, forceAtHold(body.slope));
    sum -= 0.5 * round_ * body.slope * body.slope * held * held * held;
    // int a^2 df by Simpson's rule in the cube root of the force
    const double low = std::cbrt(held);
    const double high = std::cbrt(f);
    constexpr int kParts = 16;
    double held2 = 0.0;
    for (int i = 0; i <= kParts; ++i)
    {
      const double root = low + (high - low) * i / kParts;
      const double weight = i == 0 || i == kParts ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      const double a = radiusOf(root * root * root).value;
      held2 += weight * a * a * 3.0 * root * root;
    }
    held2 *= (high - low) / (3.0 * kParts);
    sum += 0.125 * held2 / round_ - body.slope * (width.first - widthOf(held).first);
  }
  return modulus_ * sum;
}

} // namespace palp
