#include "haptics/force/nodules/nodule_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

// b / depth of the center where the contact is narrower than the nodule is deep: beyond, 10 to 24 %
// of what the nodule adds were found, and 7 to 18 % of the force where it is wider
constexpr double kCloseToNarrow = 0.75;
constexpr double kCloseToBase = 0.62; // b / height of the center over the base, the last compared

// what a nodule adds to a neo-Hookean body over what it adds to a linear one, less 1
constexpr double kAtOnce = 0.06;
constexpr double kByDepth = 0.5; // depth / depth of the center
constexpr double kLinearError = 0.03;

// of the depth of the center: what a nodule adds falls by about 1.5 times as much
constexpr double kBend = 0.2;

} // namespace

NoduleRules noduleRules(std::span<const Nodule> nodules, const NodulePress& press,
  ConstitutiveModel constitution) noexcept
{
  double close = 0.0;
  double strain = 0.0;
  for (const Nodule& nodule : nodules)
  {
    const bool narrow = press.contactRadius < nodule.top;
    close =
      std::max({ close, nodule.radius / nodule.depth() / (narrow ? kCloseToNarrow : kClosestNodule),
        nodule.radius / (press.thickness - nodule.depth()) / kCloseToBase });
    strain = std::max(strain, kAtOnce + kByDepth * press.depth / nodule.depth());
  }
  const double limit = constitution == ConstitutiveModel::Linear
    ? std::numeric_limits<double>::infinity()
    : kLinearError;
  return { {
    { "nodule", "-", close, 1.0,
      "a nodule that nearly reaches the surface or the base was not compared with finite elements; "
      "the force may be 7 to 18 % off" },
    { "nodule_strain", "-", std::abs(press.added) * strain, limit,
      "large strain may add 3 % of the force and more to what a nodule adds" },
    { "nodule_depth", "-", press.bend, kBend,
      "where the surface bends a nodule lies at another depth than its force takes it" },
  } };
}

} // namespace palp
