#include "haptics/force/linear/layer_contact.h"

#include "haptics/force/linear/contact_depth.h"
#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

constexpr int kMaxSteps = 30;        // of the secant method; three or four are usual
constexpr double kClose = 1e-8;      // of the depth; the force errs by its square
constexpr double kLongestStep = 4.0; // factor by which a step may change the depth
constexpr int kHollowSamples = 700;  // down to a thousandth of the base
constexpr double kHollowSpacing = 0.99;
constexpr double kHollowest = 1.2;    // [-] of the hollowness that is taken as it is,
constexpr double kHollowCorner = 0.2; // where a corner would be a step of the force aside

} // namespace

double fractionOfBall(double thickness, double curvature) noexcept
{
  return curvature > 0.0 ? smoothStep(0.5 * thickness * curvature) : 0.0;
}

LayerContact::LayerContact(const Tip& tip, double poissonRatio, Base base)
  : table_(tip)
  , body_(Layer(poissonRatio, base))
{
  const double m0 = 0.5 * std::numbers::pi * std::get_if<Layer>(&body_)->operator()(0.0).slope[0];
  ball_ = (3.0 - 2.0 * poissonRatio) / (4.0 * (1.0 - poissonRatio) * m0);
  if (flatRadius(tip) > 0.0)
  {
    return;
  }
  // the least of depth / a^2 over the tip, by radii: a step may lie where the depth hardly grows;
  // depth / a never falls, so from one radius to the next it is at least that of the smaller one
  double outer = table_(table_.baseDepth()).radius;
  mostHollow_ = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kHollowSamples; ++i)
  {
    const double inner = kHollowSpacing * outer;
    mostHollow_ = std::min(mostHollow_, 0.5 * contactDepth(tip, inner) / (inner * outer));
    outer = inner;
  }
}

LayerContact LayerContact::coated(const Coatings& coatings, const Material& body, Base base) const
{
  LayerContact contact = *this;
  contact.body_ = CoatedBody(coatings, body, base, table_(table_.baseDepth()).radius);
  return contact;
}

double LayerContact::allowedCurvature(double curvature) const noexcept
{
  const double most = -kHollowest * mostHollow_;
  return mostHollow_ > 0.0
    ? smoothMax(Sloped{ curvature }, Sloped{ most }, kHollowCorner * mostHollow_).value
    : 0.0;
}

double LayerContact::layerThickness(double thickness, double curvature) const noexcept
{
  return thickness / (1.0 - (1.0 - ball_) * fractionOfBall(thickness, curvature));
}

PunchSolution LayerContact::solution(double radius, double thickness) const noexcept
{
  if (const auto* coated = std::get_if<CoatedBody>(&body_))
  {
    return (*coated)(radius, thickness);
  }
  PunchSolution phi = (*std::get_if<Layer>(&body_))(radius / thickness);
  for (double& slope : phi.slope)
  {
    slope /= thickness;
  }
  return phi;
}

// phi is 1 there; by Newton, whose last step moves the radius by its slope and the force by its
// bend
std::optional<LinearContact> LayerContact::onHalfSpace(
  double depth, double curvature) const noexcept
{
  constexpr int kSteps = 4;       // two are usual
  constexpr double kLast = 1e-3;  // of the depth; the force errs by its cube
  constexpr double kLeast = 0.25; // of the slope of the depth by that of a flat body
  double flat = depth;
  for (int i = 0; i < kSteps && flat > 0.0 && flat < table_.baseDepth(); ++i)
  {
    const ContactTable::Entry entry = table_(flat, 1);
    const double a = entry.radius;
    const double more = curvature * a * a;
    const double left = depth - flat - more;
    const double slope = 1.0 + 2.0 * curvature * a * entry.radiusSlope;
    if (slope < kLeast)
    {
      break;
    }
    const double step = left / slope;
    const double wider = entry.radiusSlope * step;
    if (std::abs(step) < kLast * flat)
    {
      return LinearContact{ .force =
                              2.0 * (depth * a - entry.moments[0] - more * a / 3.0) + left * wider,
        .radius = a + wider,
        .stiffness = 2.0 * (a + wider) };
    }
    flat += step;
  }
  return std::nullopt;
}

LayerContact::Trial LayerContact::trial(
  double halfSpaceDepth, double thickness, double curvature) const noexcept
{
  const ContactTable::Entry entry = table_(halfSpaceDepth);
  const double a = entry.radius;
  const PunchSolution phi = solution(a, thickness);

  // A, B and their derivatives by a; F is stationary in a where depth = B' / A'
  const double gap = std::min(halfSpaceDepth, table_.baseDepth()) + curvature * a * a;
  Trial result{ 0.0, a, 0.0, 0.0 };
  double uniformSlope = 0.0;
  double shapeSlope = 0.0;
  for (std::size_t k = 0; k < PunchSolution::kTerms; ++k)
  {
    const auto order = static_cast<double>(2 * k);
    const double moment = entry.moments[k] + curvature * a * a * a / (order + 3.0);
    result.uniform += a * phi.value[k] / (order + 1.0);
    result.shape += phi.value[k] * moment;
    uniformSlope += (phi.value[k] + a * phi.slope[k]) / (order + 1.0);
    shapeSlope += phi.slope[k] * moment + phi.value[k] * (gap - order * moment / a);
  }
  result.depth = shapeSlope / uniformSlope;
  return result;
}

LinearContact LayerContact::operator()(
  double depth, double thickness, double curvature) const noexcept
{
  const double base = table_.baseDepth();
  const double kappa = allowedCurvature(curvature);
  if (std::isinf(thickness) && std::holds_alternative<Layer>(body_))
  {
    if (const auto contact = onHalfSpace(depth, kappa))
    {
      return *contact;
    }
  }
  double shallow = 0.0; // half-space depths between which the depth is met
  double deep = base;
  double halfSpaceDepth = std::min(depth, base);
  Trial now = trial(halfSpaceDepth, thickness, kappa);
  double nextDepth = halfSpaceDepth * depth / now.depth;
  for (int i = 0; i < kMaxSteps && std::abs(now.depth - depth) > kClose * depth; ++i)
  {
    (now.depth < depth ? shallow : deep) = halfSpaceDepth;
    nextDepth = std::clamp(nextDepth, halfSpaceDepth / kLongestStep, halfSpaceDepth * kLongestStep);
    if (!(nextDepth > shallow && nextDepth < deep))
    {
      // the base where nothing shallower was too deep, else halfway
      nextDepth = nextDepth >= base && deep == base ? base : 0.5 * (shallow + deep);
    }
    if (nextDepth == halfSpaceDepth)
    {
      break; // the whole base is in contact
    }
    const Trial next = trial(nextDepth, thickness, kappa);
    const double chord = (next.depth - now.depth) / (nextDepth - halfSpaceDepth);
    halfSpaceDepth = nextDepth;
    now = next;
    nextDepth = halfSpaceDepth + (depth - now.depth) / chord;
  }
  return { .force = std::max(0.0, 2.0 * (depth * now.uniform - now.shape)),
    .radius = now.radius,
    .stiffness = 2.0 * now.uniform };
}

} // namespace palp
