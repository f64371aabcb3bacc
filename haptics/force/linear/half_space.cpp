#include "haptics/force/linear/half_space.h"

#include "haptics/force/linear/contact_depth.h"
#include "haptics/numerics/roots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

// the answer before the base is in contact

LinearContact contactOf(const SphereTip& tip, double depth) noexcept
{
  // a = R tanh(p), depth = R p tanh(p); small p by the series, where the difference loses digits
  const double ratio = depth / tip.radius;
  const double ratio2 = ratio * ratio;
  // to 0.3 % for any depth, so that Halley's second step has every digit
  double p = std::sqrt(ratio +
    ratio2 * (1.0 / 3.0 + 0.128 * ratio + 0.1493 * ratio2) /
      (1.0 + 0.238 * ratio + 0.1493 * ratio2));
  double t = 0.0;
  for (int i = 0; i < 2; ++i)
  {
    t = std::tanh(p);
    const double falling = 1.0 - t * t; // slope of tanh
    const double off = p * t - ratio;
    const double slope = t + p * falling;
    const double step = off * slope / (slope * slope - off * falling * (1.0 - p * t));
    p -= step;
    t -= step * falling;
  }
  const double p2 = p * p;
  const double area = p < 0.03
    ? p * p2 * (4.0 / 3.0 - p2 * (4.0 / 5.0 - p2 * (136.0 / 315.0 - p2 * (124.0 / 567.0))))
    : (1.0 + t * t) * p - t;
  return { tip.radius * tip.radius * area, tip.radius * t };
}

LinearContact contactOf(const ConeTip& tip, double depth) noexcept
{
  const double a = 2.0 / std::numbers::pi * depth * std::tan(tip.halfAngle);
  return { a * depth, a };
}

LinearContact contactOf(const PunchTip& tip, double depth) noexcept
{
  return { 2.0 * tip.radius * depth, tip.radius };
}

LinearContact contactOf(const TruncatedConeTip& tip, double depth) noexcept
{
  // a = b / sin(q), where q + k sin(q) = pi / 2; concave, so it converges from below
  const double k = depth / (tip.flatRadius * cot(tip.halfAngle));
  constexpr double right = 0.5 * std::numbers::pi;
  const double q = newton(right / (1.0 + k),
    [k](double x) { return (x + k * std::sin(x) - right) / (1.0 + k * std::cos(x)); });
  const double a = tip.flatRadius / std::sin(q);
  return { cot(tip.halfAngle) * (a * a * (right - q) + tip.flatRadius * a * std::cos(q)), a };
}

LinearContact contactOf(const BluntConeTip& tip, double depth) noexcept
{
  const CappedCone cone(tip);
  const double rho = cone.rho;
  const double b = cone.b;
  const double n = cone.n;
  if (depth <= contactDepth(SphereTip{ rho }, b))
  {
    return contactOf(SphereTip{ rho }, depth);
  }
  // g is concave beyond the cap and below its asymptote, so it converges from the left
  const double lift = rho * rho / n - rho; // of the tip over the apex of the sharp cone
  const double start = std::max(b, 2.0 / std::numbers::pi * (depth + lift) * n / b);
  const double a = newton(start,
    [&](double x)
    {
      const double g = cone.steepness(x);
      const double m = cone.m(x);
      return (x * g - depth) / (g + x / (x + rho) + (b * b - n * m) / (n * (m + n)));
    });
  // F / E* with the logarithm and the angle of the steepness, whose sum is depth / a
  const double m = cone.m(a);
  const double log = std::log((a + rho) / (m + n));
  return { a * depth + rho * rho * log - a * rho + m * n + b * b * m / n, a };
}

// Hertz
LinearContact contactOf(const ParaboloidTip& tip, double depth) noexcept
{
  const double a = std::sqrt(tip.radius * depth);
  return { 4.0 / 3.0 * a * depth, a };
}

LinearContact contactOf(const ProfileTip&, double) noexcept
{
  return {}; // from its table
}

LinearContact contactOf(const ContactTable& table, double depth) noexcept
{
  const ContactTable::Entry entry = table(depth);
  return { entry.force, entry.radius };
}

} // namespace

HalfSpace::HalfSpace(const Tip& tip)
  : tip_(tip)
  , baseRadius_(baseRadius(tip))
  , baseDepth_(palp::contactDepth(tip, baseRadius_))
{
  if (std::holds_alternative<ProfileTip>(tip))
  {
    table_ = std::make_shared<const ContactTable>(tip);
  }
}

LinearContact HalfSpace::operator()(double depth) const noexcept
{
  const double before = std::min(depth, baseDepth_);
  LinearContact contact = table_ != nullptr
    ? contactOf(*table_, before)
    : onTip(tip_, [before](const auto& shape) { return contactOf(shape, before); });
  if (depth >= baseDepth_)
  {
    contact.radius = baseRadius_;
    contact.force += 2.0 * baseRadius_ * (depth - baseDepth_);
  }
  contact.stiffness = 2.0 * contact.radius;
  return contact;
}

} // namespace palp
