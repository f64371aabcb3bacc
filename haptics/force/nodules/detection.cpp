#include "haptics/force/nodules/detection.h"

#include "haptics/error.h"
#include "haptics/force/nodules/nodule_increment.h"
#include "haptics/numerics/roots.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kSmallestBall = 0.1_mm; // radius that checkedNodule takes
constexpr double kLargestBall = 100.0_mm;
constexpr double kGrowth = 1.25; // from one radius to the next while a bracket is sought
constexpr double kBallTolerance = 0.1_um;
constexpr int kMostTrials = 60;
constexpr double kNearlyThere = 1e-12; // contrast, for a bracket whose end is the root

// the press whose last knot lies at the depth of the place
HomogeneousPress pressTo(const ForceLaw& law, const ContactGeometry& place)
{
  constexpr double kInUse = HomogeneousPress::kInUse;
  return { law, place, kInUse * kInUse * place.depth };
}

// radius of the largest nodule
double largestBelow(const NoduleContrast& contrast, double cover)
{
  const double fits = 0.5 * (contrast.thickness() - cover);
  if (!(fits > kSmallestBall))
  {
    throw Error(ErrorCode::BadValue,
      "no nodule fits between this cover and the base of the body; give less cover, or a thicker "
      "body");
  }
  return std::min({ kLargestBall, fits, kClosestNodule / (1.0 - kClosestNodule) * cover });
}

// beyond what people notice [-]
double excess(const JustNoticeable& noticed, const Detectable& one)
{
  return std::abs(noticed.difference(one.contrast)) - noticed.fraction;
}

// ever larger nodules, up to the largest or to one that is noticed in every way
template <typename Of>
std::vector<Detectable> grow(const Of& of, double largest, std::span<const JustNoticeable> noticed)
{
  std::vector<Detectable> grown{ of(kSmallestBall) };
  const auto isMissed = [&](const JustNoticeable& one) { return excess(one, grown.back()) < 0.0; };
  while (grown.back().nodule.radius < largest && std::ranges::any_of(noticed, isMissed))
  {
    grown.push_back(of(std::min(largest, kGrowth * grown.back().nodule.radius)));
  }
  return grown;
}

} // namespace

NoduleContrast::NoduleContrast(const ForceLaw& law, const ContactGeometry& place)
  : press_(pressTo(law, place))
  , thickness_(std::min(place.thickness, press_.thickness()))
{
}

double NoduleContrast::operator()(const Nodule& nodule) const
{
  return increment::ofNodule(firstOrderIncrements(press_, nodule, 0.0).back());
}

NoduleRules NoduleContrast::rules(const Nodule& nodule) const
{
  const HomogeneousPress::Knot& deepest = press_.knots().back();
  const double contrast = (*this)(nodule);
  return noduleRules(std::span(&nodule, 1),
    { .depth = deepest.depth,
      .contactRadius = deepest.radius,
      .thickness = thickness_,
      .added = contrast / (1.0 + contrast) },
    press_.law().settings().constitution);
}

std::vector<std::optional<Detectable>> smallestDetectable(const NoduleContrast& contrast,
  double cover, double ratio, std::span<const JustNoticeable> noticed)
{
  const auto of = [&](double radius)
  {
    const Nodule nodule{ .radius = radius, .top = cover, .ratio = ratio };
    return Detectable{ nodule, contrast(nodule) };
  };
  (void)checkedNodule({ .radius = kSmallestBall, .top = cover, .ratio = ratio });
  const std::vector<Detectable> grown = grow(of, largestBelow(contrast, cover), noticed);
  std::vector<std::optional<Detectable>> found;
  for (const JustNoticeable& difference : noticed)
  {
    const auto over = [&](const Detectable& one) { return excess(difference, one); };
    const auto first =
      std::ranges::find_if(grown, [&](const Detectable& one) { return over(one) >= 0.0; });
    if (first == grown.end() || first == grown.begin())
    {
      found.push_back(first == grown.end() ? std::nullopt : std::optional(*first));
      continue;
    }
    const Detectable& before = *std::prev(first);
    const RootBracket root = falsePosition([&](double radius) { return over(of(radius)); },
      { before.nodule.radius, first->nodule.radius }, over(before),
      std::max(over(*first), kNearlyThere), kBallTolerance, kMostTrials);
    found.emplace_back(of(root.high));
  }
  return found;
}

} // namespace palp
