#include "haptics/force/linear/series_contact.h"

#include "haptics/numerics/roots.h"

#include <algorithm>
#include <cmath>

namespace palp
{

double asideOf(double pull, double edge) noexcept
{
  // from above, where the cubic is convex: from 59 % at most to 2e-7
  double x = edge > 0.0 ? std::min(pull, std::cbrt(pull / (edge * edge))) : pull;
  constexpr int kSteps = 4;
  for (int i = 0; i < kSteps && edge != 0.0; ++i)
  {
    const double far = 1.0 + edge * x;
    x -= (x * far * far - pull) / (far * (far + 2.0 * edge * x));
  }
  return x;
}

SeriesContact inSeries(
  const HalfSpace& local, const BodyCompliance& body, double depth, double radius) noexcept
{
  // by which the tip has come down where it is so deep in the body
  const auto total = [&](double deep)
  {
    const LinearContact contact = local(deep);
    constexpr double widened = 4.0 / 15.0; // of a pressure as that of a paraboloid
    const double rigid = deep +
      contact.force * (body.constant + widened * body.bend * contact.radius * contact.radius);
    if (!(radius > 0.0))
    {
      return rigid;
    }
    const double pull = radius * body.slope * contact.force;
    const double aside = std::min(asideOf(pull, body.edge), 0.5 * contact.radius);
    return rigid - 2.0 * contact.force * body.slope * aside / (1.0 + body.edge * aside) +
      0.5 * aside * aside / radius;
  };
  // the first root: over a near support the body would pull beyond the last
  constexpr int kSteps = 64;
  constexpr int kMost = 4 * kSteps; // four times as deep as the tip came down
  RootBracket root{ 0.0, depth / kSteps };
  double reached = 0.0;
  int step = 1;
  for (double there = total(root.high); there < depth && there > reached && step < kMost; ++step)
  {
    reached = there;
    root = { root.high, root.high + depth / kSteps };
    there = total(root.high);
  }
  const bool isFound = total(root.high) >= depth;
  constexpr int kHalvings = 50;
  const double deep = isFound
    ? bisect([&](double one) { return total(one) < depth; }, root, kHalvings).high
    : root.low;
  SeriesContact result{ .contact = local(deep), .local = deep, .isBeyond = !isFound };
  const double small = 1e-4 * deep;
  const double slope = (total(deep + small) - total(deep - small)) / (2.0 * small);
  result.contact.stiffness = slope > 0.0 ? result.contact.stiffness / slope : 0.0;
  return result;
}

} // namespace palp
