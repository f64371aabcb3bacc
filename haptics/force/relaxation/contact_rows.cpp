#include "haptics/force/relaxation/contact_rows.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kFarthest = 1.0; // [m]; no law answers deeper

// fine where the contact begins, since dF/ddepth there goes with the root of the depth
double edgeAt(std::size_t j, double deepest)
{
  if (j <= ContactRows::kFine)
  {
    const double fraction = static_cast<double>(j) / ContactRows::kFine;
    return deepest * fraction * fraction;
  }
  const double fraction =
    static_cast<double>(j - ContactRows::kFine) / (ContactRows::kCount - ContactRows::kFine);
  return deepest * std::pow(std::max(2.0, kFarthest / deepest), fraction);
}

} // namespace

ContactRows::ContactRows(
  const std::function<ElasticForce(double)>& law, double deepest, Softening softening)
{
  double force = 0.0;
  for (std::size_t j = 0; j < kCount; ++j)
  {
    edges[j + 1] = edgeAt(j + 1, deepest);
    const ElasticForce at = law(edges[j + 1]);
    const double width = edges[j + 1] - edges[j];
    const bool kept = softening == Softening::Kept;
    total[j + 1] = kept ? at.stiffness : std::max(total[j], at.stiffness);
    stiffness[j] = total[j + 1] - total[j];
    // where the row must be met for the force at its lower edge to be the law's
    const double rest = at.force - force - total[j] * width;
    if (kept && !(rest * stiffness[j] > 0.0 && rest / stiffness[j] <= width))
    {
      stiffness[j] = rest / width; // nowhere between: as soft as the force itself tells
      total[j + 1] = total[j] + stiffness[j];
    }
    const bool isMet = kept ? rest != 0.0 : rest > 0.0;
    depth[j] = edges[j + 1] - (isMet ? std::min(rest / stiffness[j], width) : 0.0);
    force = at.force;
  }
}

void ContactRows::scaleBlock(
  const ContactRows& usual, std::size_t begin, const std::array<double, 3>& ratios) noexcept
{
  const double slope = ratios[1] - ratios[0];
  const double bend = 0.5 * (ratios[2] - 2.0 * ratios[1] + ratios[0]);
  for (std::size_t j = begin; j < begin + kBlock; ++j)
  {
    const double fraction = static_cast<double>(j + 1 - begin) / kBlock;
    const double ratio = ratios[0] + fraction * (slope + (fraction - 1.0) * bend);
    total[j + 1] = std::max(total[j], usual.total[j + 1] * ratio);
    stiffness[j] = total[j + 1] - total[j];
  }
}

void ContactRows::scaleTo(double force, double atDepth, std::size_t rows) noexcept
{
  double sum = 0.0;
  for (std::size_t j = 0; j < rows; ++j)
  {
    sum += stiffness[j] * std::max(0.0, atDepth - depth[j]);
  }
  const double scale = sum > 0.0 && force > 0.0 ? force / sum : 1.0;
  for (std::size_t j = 0; j < rows; ++j)
  {
    stiffness[j] *= scale;
    total[j + 1] *= scale;
  }
}

} // namespace palp
