#include "calibration/study/mesh_check.h"

#include "haptics/error.h"

#include <algorithm>
#include <cmath>

namespace palp::fem
{
namespace
{

// largest change seen under spheres and cones, times (contact radius / element size)^2 [-]
constexpr double kAtTheEdge = 0.07;
constexpr double kNextChange = 1.0 / 3.0; // 1/4 for the second order of a smooth contact [-]

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
      return std::max(seen, kAtTheEdge / (elements * elements));
    }
  }
  catch (const Error&)
  {
    lost_ = true;
  }
  return HUGE_VAL;
}

} // namespace palp::fem
