#include "haptics/contact/patch.h"

#include "haptics/contact/disc_integral.h"
#include "haptics/numerics/box_probe.h"
#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kCone = 1.0 / 3.0; // volume by base and height

// of Q, as far as the ball reaches behind a plane: with less its rim, which is all at once 2 pi
// where the ball meets a far wall, counts gradually
constexpr double kNew = 0.1;

// one of the triangles
struct Seen
{
  const Facet& facet;
  DiscIntegral inside;
  double height;                                    // of the center over its plane [m]
  double part = 1.0;                                // that counts [-]
  Eigen::Vector3d change = Eigen::Vector3d::Zero(); // of that part as the center moves [1/m]
  double byTurning = 0.0;                           // of it over how fast it fades [m]
};

// use(seen) for each triangle in the ball
template <typename Use>
void visit(const Surface& surface, const PatchBall& ball, Use use) noexcept
{
  const double squaredRadius = ball.radius * ball.radius;
  const BoxTree& tree = surface.tree();
  const BoxProbe probe(ball.center);
  const auto near = [&](const BoxTree::Node& box)
  { return static_cast<double>(probe.squaredDistance(box)) < squaredRadius; };
  const auto add = [&](int i)
  {
    const Facet& facet = tree.facets()[static_cast<std::size_t>(i)];
    const DiscIntegral inside = integrate(facet, ball.center, squaredRadius);
    if (!(inside.weight > 0.0))
    {
      return;
    }
    Seen seen{ facet, inside, facet.normal.dot(ball.center - facet.corners[0]) };
    if (const double faced = std::max(0.0, 1.0 + ball.turning * seen.height); faced < 1.0)
    {
      seen.part = smoothStep(faced);
      const double fall = 6.0 * faced * (1.0 - faced);
      seen.change = fall * ball.turning * facet.normal;
      seen.byTurning = fall * seen.height;
    }
    use(seen);
  };
  tree.search(near, add);
}

} // namespace

Patch patchWithin(const Surface& surface, const PatchBall& ball, double inside) noexcept
{
  Patch patch;
  double solidAngle = 0.0;
  const double radius = ball.radius;
  const double squaredRadius = radius * radius;
  const double byArea = 2.0 / 15.0 * squaredRadius;
  const double byAngle = kCone * squaredRadius * radius; // of the volume
  const double full = byArea * squaredRadius * radius;   // of w
  const double toNew = 1.0 / (kNew * squaredRadius);
  const auto add = [&](const Seen& one)
  {
    const auto& [facet, within, height, part, change, byTurning] = one;
    const double seen = std::copysign(within.solidAngle, -height);
    const double nearer = -height * (byArea * within.area + 0.2 * within.weight);
    const double below = -kCone * height * within.area;
    if (part < 1.0)
    {
      const SeamIntegral seams = seamsOf(facet, ball.center, squaredRadius);
      const double moment = nearer - full * seen;
      const double volume = below - byAngle * seen;
      patch.fading += (1.0 - part) * seams.moment - moment * change;
      patch.volumeFading += (1.0 - part) * seams.volume - volume * change;
      patch.turns.moment += moment * byTurning;
      patch.turns.volume += volume * byTurning;
      patch.turns.weight += within.weight * byTurning;
      patch.turns.normal += within.weight * byTurning * facet.normal;
      patch.orientationSum += (1.0 - part) * within.weight * facet.normal;
      patch.orientationWeight += (1.0 - part) * within.weight;
    }
    const Eigen::Vector3d slope =
      part * weightSlope(facet, ball.center, squaredRadius, within) + within.weight * change;
    patch.slopes.normal += facet.normal * slope.transpose();
    patch.slopes.weight += slope;
    patch.slopes.area += part * within.area;
    patch.weight += part * within.weight;
    patch.normal += part * within.weight * facet.normal;
    patch.area += part * within.area * facet.normal;
    patch.volume += part * below;
    patch.moment += part * nearer;
    solidAngle += part * seen;
    if (within.rim > 0.0)
    {
      const double reached = toNew * (squaredRadius - height * height);
      const double rim = part * std::min(1.0, reached) * within.rim;
      patch.rim += rim * facet.normal;
      patch.solidAngleSlope += rim * height;
    }
  };
  visit(surface, ball, add);
  patch.orientationSum += patch.normal;
  patch.orientationWeight += patch.weight;
  patch.solidAngle = 4.0 * std::numbers::pi * inside - solidAngle;
  patch.solidAngleSlope /= squaredRadius * radius;
  patch.volume += byAngle * patch.solidAngle;
  patch.moment += full * patch.solidAngle;
  return patch;
}

} // namespace palp
