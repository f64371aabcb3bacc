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

SeriesLaw::SeriesLaw(const ForceLaw& law)
  : modulus_(law.material().contactModulus())
  , round_(roundnessOf(law.tip()))
  , axis_{ 0.0, 1.0, kIntervals }
{
  const HalfSpace contact(law.tip());
  const double deepest = kDeepest * baseRadius(law.tip());
  axis_.last = std::cbrt(contact(deepest).force);
  radii_.emplace(axis_, radiiOf(contact, axis_.last, deepest));
  widened_.emplace(axis_, widenedOf(*radii_, axis_));
}

SeriesLaw::Radius SeriesLaw::radiusOf(double force) const noexcept
{
  const double root = std::cbrt(std::max(0.0, force));
  const CubicSpline::Value radius = (*radii_)(root);
  return { radius.value,
    root > 0.0 && root < axis_.last ? radius.slope / (3.0 * root * root) : 0.0 };
}

double SeriesLaw::widened(double force) const noexcept
{
  const double root = std::cbrt(std::max(0.0, force));
  const double known = (*widened_)(root).value;
  if (root <= axis_.last)
  {
    return known;
  }
  const double edge = axis_.last * axis_.last * axis_.last;
  const double radius = (*radii_)(root).value; // as wide as where the tables end
  return known + 0.5 * radius * radius * (force * force - edge * edge);
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
  const double aside = asideOf(round_ * body.slope * force, body.edge);
  if (aside <= 0.5 * a)
  {
    const double far = 1.0 + body.edge * aside;
    const double less = 2.0 * body.slope * aside / far;
    yield.depth += 0.5 * aside * aside / round_ - force * less;
    yield.slope -= less + body.slope * aside / (far * (far + 2.0 * body.edge * aside));
    return yield;
  }
  const double far = 1.0 + 0.5 * body.edge * a;
  yield.depth += a * (0.125 * a / round_ - force * body.slope / far);
  yield.slope +=
    0.25 * a * width.slope / round_ - body.slope / far * (a + force * width.slope / far);
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
  double y = 1.0 / (1.0 + given);
  for (int i = 0; i < 2; ++i)
  {
    const double yields = given * std::pow(y, power);
    y = std::max(0.1 * y, y - (y + yields - 1.0) / (1.0 + power * yields / y));
  }
  return y * depth;
}

// from which on the pressure moves aside by no more than half of the contact's radius
double SeriesLaw::forceAtHold(const BodyCompliance& body) const noexcept
{
  double root = axis_.last;
  for (int i = 0; i < 5; ++i)
  {
    const double wide = radiusOf(root * root * root).value / root;
    const double level = std::sqrt(0.5 * wide / (round_ * body.slope)); // without an edge
    const double slower = 1.0 - 0.5 * level * wide * body.edge;
    root = slower > 0.0 ? std::min(axis_.last, level / slower) : axis_.last;
  }
  return root * root * root;
}

SeriesLaw::Gain SeriesLaw::gainOf(double force, const BodyCompliance& body) const noexcept
{
  if (!(round_ > 0.0 && body.slope > 0.0))
  {
    return {};
  }
  double held = force;
  double aside = asideOf(round_ * body.slope * force, body.edge);
  if (aside > 0.5 * radiusOf(force).value)
  {
    held = std::min(force, forceAtHold(body));
    aside = asideOf(round_ * body.slope * held, body.edge);
  }
  const double nearer = held * aside / (1.0 + body.edge * aside);
  Gain gain{ .energy = held * (0.5 * aside * aside / round_ - body.slope * nearer),
    .slope = -held * nearer,
    .edge = body.slope * nearer * nearer };
  // from there on by Gauss and Legendre's rule in the cube root of the force
  constexpr std::array kNodes{ 0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
    0.93056815579702629 };
  constexpr std::array kWeights{ 0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
    0.17392742256872693 };
  const double low = std::cbrt(held);
  const double span = std::cbrt(force) - low;
  for (std::size_t i = 0; i < kNodes.size() && force > held; ++i)
  {
    const double root = low + span * kNodes[i];
    const double f = root * root * root;
    const double a = radiusOf(f).value;
    const double part = 3.0 * root * root * span * kWeights[i];
    const double far = 1.0 + 0.5 * body.edge * a;
    gain += { .energy = part * a * (0.125 * a / round_ - f * body.slope / far),
      .slope = -part * f * a / far,
      .edge = 0.5 * part * f * body.slope * (a / far) * (a / far) };
  }
  return gain;
}

Eigen::Vector3d SeriesLaw::lateral(const ComplianceField::Local& local, double force) const noexcept
{
  const double f = force / modulus_;
  const Gain gain = gainOf(f, local.body);
  return modulus_ *
    (0.5 * f * f * local.constant + kWidened * widened(f) * local.bend + gain.slope * local.slope +
      gain.edge * local.edge);
}

double SeriesLaw::energy(const BodyCompliance& body, double force) const noexcept
{
  const double f = force / modulus_;
  return modulus_ *
    (0.5 * f * f * body.constant + kWidened * widened(f) * body.bend + gainOf(f, body).energy);
}

} // namespace palp
