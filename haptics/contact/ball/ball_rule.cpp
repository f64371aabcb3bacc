#include "haptics/contact/ball/ball_rule.h"

#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

// Facets are smoothed out over a part of the contact, for what a scanner stepped comes through when
// the mesh is fine, but over enough of them to vanish and no more than the tick has time for
constexpr double kSmoothed = 0.63; // [-] of the contact's radius
constexpr double kFewest = 1.8;    // [-] facet lengths; below 1.5 the facets come through
constexpr double kMost = 6.5;      // [-] edge lengths
constexpr double kRounded = 0.4; // [-] of the fewest: corners of that rule, whose slope is a force

} // namespace

BallRule::BallRule(const Tip& tip, double edgeLength, double facetLength) noexcept
  : nose_(noseRadius(tip))
  , edge_(edgeLength)
  , facet_(facetLength)
{
}

Sloped BallRule::contactRadius(double height) const noexcept
{
  const double outside = std::max(0.0, height);
  const double radius = std::sqrt(std::max(0.0, nose_ * nose_ - outside * outside));
  return { radius, radius > 0.0 ? -outside / radius : 0.0 };
}

BallSize BallRule::operator()(double height) const noexcept
{
  const Sloped contact = contactRadius(height);
  const double fewest = kFewest * facet_;
  const double width = kRounded * fewest;
  const Sloped part{ kSmoothed * contact.value, kSmoothed * contact.slope };
  const Sloped wanted = smoothMin(part, { kMost * edge_ }, kRounded * kFewest * edge_);
  const Sloped smoothing = smoothMin(contact, smoothMax(wanted, { fewest }, width), width);
  const auto [radius, slope] = smoothing;
  return { smoothing, { height * height + radius * radius, 2.0 * (height + radius * slope) } };
}

} // namespace palp
