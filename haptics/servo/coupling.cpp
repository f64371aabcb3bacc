#include "haptics/servo/coupling.h"

#include "haptics/numerics/roots.h"

#include <cmath>

namespace palp
{
namespace
{

constexpr int kHalvings = 32; // relative 2e-10; the force depends on its square

// end of the first part of [0, upTo] on which a condition holds; it fails at upTo
template <typename Holds>
double lastWhere(const Holds& holds, double from, double upTo) noexcept
{
  return bisect(holds, { from, upTo }, kHalvings).low;
}

struct Knee
{
  double depth;
  double force;
};

// where the law becomes stiffer than the limit; infinite values count as stiffer
// @param last  what the law says at upTo
Knee kneeOf(const DepthLaw& law, double upTo, const Response& last, double limit) noexcept
{
  const auto isSoft = [limit](const Response& at, double depth)
  { return at.stiffness <= limit && at.force <= limit * depth; };
  if (isSoft(last, upTo))
  {
    return { upTo, last.force };
  }
  const double depth = lastWhere([&](double at) { return isSoft(law(at), at); }, 0.0, upTo);
  return { depth, depth > 0.0 ? law(depth).force : 0.0 };
}

double inverse(const DepthLaw& law, double force, double from, double upTo) noexcept
{
  return lastWhere([&](double depth) { return law(depth).force <= force; }, from, upTo);
}

} // namespace

Rendered couple(const DepthLaw& law, double depth, double limit) noexcept
{
  if (!(depth > 0.0) || !(limit > 0.0) || !std::isfinite(depth))
  {
    return {};
  }
  const Response at = law(depth);
  if (std::isnan(at.force))
  {
    return {};
  }
  const Knee knee = kneeOf(law, depth, at, limit);
  if (knee.depth == depth)
  {
    return { at.force, at.stiffness, depth, false, depth, at.force };
  }
  const double force = knee.force + limit * (depth - knee.depth);
  if (at.force <= force) // falls below the spring again
  {
    return { at.force, std::fmin(at.stiffness, limit), depth, false, depth, at.force };
  }
  return { force, limit, inverse(law, force, knee.depth, depth), true, knee.depth, knee.force };
}

double storedEnergy(const DepthLaw& law, const Rendered& felt, double depth) noexcept
{
  if (!(felt.force > 0.0))
  {
    return 0.0;
  }
  const double spring = 0.5 * (felt.kneeForce + felt.force) * (depth - felt.kneeDepth);
  return spring + law.energy(felt.kneeDepth);
}

double depthOf(const DepthLaw& law, double force, double limit, double upTo) noexcept
{
  if (!(force > 0.0) || !(upTo > 0.0))
  {
    return 0.0;
  }
  const Knee knee = kneeOf(law, upTo, law(upTo), limit);
  const double depth = force > knee.force ? knee.depth + (force - knee.force) / limit
                                          : inverse(law, force, 0.0, knee.depth);
  return std::fmin(depth, upTo);
}

} // namespace palp
