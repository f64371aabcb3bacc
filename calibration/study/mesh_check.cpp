#include "calibration/study/mesh_check.h"

#include "haptics/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp::fem
{
namespace
{

// largest change seen under spheres and cones of 45 degrees and more, times (contact radius /
// element size)^2 [-]; sharper ones, whose change comes in leaps of 2 %, are given that power of
// their slope
constexpr double kAtTheEdge = 0.07;
constexpr double kSharper = 6.0;
constexpr double kSteepest = 2.0;
constexpr double kNextChange = 1.0 / 3.0; // 1/4 for the second order of a smooth contact [-]
constexpr double kFinest = 0.1;           // elements for a shallow contact, over those of the case
constexpr double kFewest = 2.0; // elements across a contact, before its force is looked at

Case withLargerElements(Case study)
{
  study.elementSize = 2.0 * elementSize(study);
  return study;
}

} // namespace

MeshCheck::MeshCheck(const Case& study)
  : body_(bodyOf(withLargerElements(study)))
  , indenter_(body_, study.tip, study.energy, study.material)
{
}

double MeshCheck::changeOnHalving(const IndentationStep& step, const std::stop_token& stop)
{
  try
  {
    if (!lost_)
    {
      indenter_.press(step.depth, stop);
      const double seen = kNextChange * std::abs(indenter_.state().force / step.force - 1.0);
      const double elements = step.contactRadius / body_.elementSize * 2.0;
      const double slope = 2.0 / std::numbers::pi * step.depth / step.contactRadius; // of a cone
      const double leap = std::pow(std::clamp(slope, 1.0, kSteepest), kSharper);
      return std::max(seen, kAtTheEdge * leap / (elements * elements));
    }
  }
  catch (const Error&)
  {
    lost_ = true;
  }
  return HUGE_VAL;
}

std::optional<IndentationStep> onFinerElements(
  const Case& study, double depth, const std::stop_token& stop)
{
  constexpr int kSteps = 4;
  Case finer = study;
  finer.depths = { depth };
  for (finer.elementSize = 0.5 * elementSize(study);
       finer.elementSize >= std::max(kSmallestElement, kFinest * elementSize(study));
       finer.elementSize *= 0.5)
  {
    if (contactReach(study.tip, depth) < kFewest * finer.elementSize)
    {
      continue;
    }
    try
    {
      const Body body = bodyOf(finer);
      Indenter indenter(body, finer.tip, finer.energy, finer.material);
      MeshCheck coarser(finer);
      for (int i = 1; i <= kSteps; ++i)
      {
        indenter.press(depth * i / kSteps, stop);
      }
      IndentationStep found = indenter.state();
      if (coarser.changeOnHalving(found, stop) <= kMeshError)
      {
        return found;
      }
    }
    catch (const Error&)
    {
      if (stop.stop_requested())
      {
        break;
      }
    }
  }
  return std::nullopt;
}

} // namespace palp::fem
