#include "haptics/force/linear/contact_table.h"

#include "haptics/force/linear/contact_depth.h"
#include "haptics/numerics/monotone_cubic.h"
#include "haptics/numerics/roots.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace palp
{
namespace
{

constexpr int kKnots = 512;
constexpr double kShallowest = 1e-9; // of the base depth; below, the power law of the first knot
constexpr double kEquator = 1e-9;    // of R, left out of a sphere, whose base depth is infinite

// radius at which g reaches a depth, known to lie between low and high
double contactRadius(const Tip& tip, double depth, double low, double high)
{
  const auto excess = [&](double radius) noexcept { return contactDepth(tip, radius) - depth; };
  const double below = excess(low);
  const double above = excess(high);
  if (!(above > 0.0))
  {
    return high; // rounding at a wall, which rises by more than one knot between two numbers
  }
  if (below >= 0.0)
  {
    return low;
  }
  const RootBracket found = falsePosition(excess, { low, high }, below, above, 1e-14 * high, 60);
  return 0.5 * (found.low + found.high);
}

// radii at depths from the base down; g(a)/a never decreases in a, which brackets each next one
std::vector<double> contactRadii(
  const Tip& tip, const std::vector<double>& logs, double step, double base)
{
  std::vector<double> radii(logs.size(), base);
  for (std::size_t knot = logs.size() - 1; knot-- > 0;)
  {
    radii[knot] = contactRadius(tip, std::exp(logs[knot]),
      std::max(flatRadius(tip), radii[knot + 1] * std::exp(-step)), radii[knot + 1]);
  }
  return radii;
}

// integrals of g s^(2k) between two radii, by Gauss
void addMoments(const Tip& tip, double from, double to, std::span<double> sums)
{
  for (const double node : { -std::sqrt(0.6), 0.0, std::sqrt(0.6) })
  {
    const double s = from + 0.5 * (1.0 + node) * (to - from);
    double integrand = (node == 0.0 ? 4.0 : 2.5) / 9.0 * (to - from) * contactDepth(tip, s);
    for (double& sum : sums)
    {
      sum += integrand;
      integrand *= s * s;
    }
  }
}

} // namespace

ContactTable::ContactTable(const Tip& tip)
{
  const bool sphere = std::holds_alternative<SphereTip>(tip);
  base_.radius = baseRadius(tip) * (sphere ? 1.0 - kEquator : 1.0);
  baseDepth_ = contactDepth(tip, base_.radius);
  if (!(baseDepth_ > 0.0))
  {
    baseDepth_ = 0.0;
    return;
  }
  firstLog_ = std::log(kShallowest * baseDepth_);
  const double step = -std::log(kShallowest) / (kKnots - 1);
  perStep_ = 1.0 / step;

  std::vector<double> logs(kKnots);
  for (int i = 0; i < kKnots; ++i)
  {
    logs[static_cast<std::size_t>(i)] = firstLog_ + i * step;
  }
  const std::vector<double> radii = contactRadii(tip, logs, step, base_.radius);
  const std::vector<double> slopes = monotoneSlopes(logs, radii);

  // integrals of g s^(2k): below the first knot a ~ depth^p in closed form, then Gauss
  std::array<double, kMoments> sums{};
  const double power = slopes[0] / radii[0];
  for (std::size_t k = 0; k < kMoments; ++k)
  {
    const double order = 2.0 * static_cast<double>(k) + 1.0;
    sums[k] = std::exp(firstLog_) * std::pow(radii[0], order) * power / (1.0 + order * power);
  }
  knots_.resize(kKnots);
  for (std::size_t i = 0; i < knots_.size(); ++i)
  {
    addMoments(tip, i > 0 ? radii[i - 1] : radii[0], radii[i], sums);
    const double depth = std::exp(logs[i]);
    Knot& knot = knots_[i];
    knot.value.radius = radii[i];
    const double rise = step * slopes[i];
    knot.slope.radius = rise;
    knot.value.force = 2.0 * (depth * radii[i] - sums[0]);
    knot.slope.force = 2.0 * step * depth * radii[i];
    double scale = 1.0;
    for (std::size_t k = 0; k < kMoments; ++k)
    {
      const double moment = sums[k] / scale;
      knot.value.moments[k] = moment;
      knot.slope.moments[k] = (depth - 2.0 * static_cast<double>(k) * moment / radii[i]) * rise;
      scale *= radii[i] * radii[i];
    }
  }
  base_ = knots_.back().value;
}

ContactTable::Entry ContactTable::operator()(double depth, std::size_t moments) const noexcept
{
  if (depth >= baseDepth_)
  {
    return base_;
  }
  const double log = std::log(depth);
  const double along = (log - firstLog_) * perStep_;
  Entry entry;
  if (along < 0.0)
  {
    // a ~ depth^p
    const Knot& first = knots_.front();
    const double exponent = first.slope.radius * perStep_ / first.value.radius;
    const double shrink = std::exp(exponent * (log - firstLog_));
    entry.radius = first.value.radius * shrink;
    entry.radiusSlope = exponent * entry.radius / depth;
    const double scale = shrink * depth / std::exp(firstLog_);
    entry.force = first.value.force * scale;
    for (std::size_t k = 0; k < moments; ++k)
    {
      entry.moments[k] = first.value.moments[k] * scale;
    }
    return entry;
  }
  const std::size_t i = std::min(static_cast<std::size_t>(along), knots_.size() - 2);
  const double fraction = std::min(1.0, along - static_cast<double>(i));
  const Knot& low = knots_[i];
  const Knot& high = knots_[i + 1];
  const auto read = [&](double y0, double y1, double slope0, double slope1)
  { return hermite(fraction, 1.0, y0, y1, slope0, slope1); };
  entry.force = read(low.value.force, high.value.force, low.slope.force, high.slope.force).value;
  const Cubic radius =
    read(low.value.radius, high.value.radius, low.slope.radius, high.slope.radius);
  entry.radius = radius.value;
  entry.radiusSlope = radius.slope * perStep_ / depth;
  for (std::size_t k = 0; k < moments; ++k)
  {
    entry.moments[k] =
      read(low.value.moments[k], high.value.moments[k], low.slope.moments[k], high.slope.moments[k])
        .value;
  }
  return entry;
}

} // namespace palp
