#include "calibration/mesh_check.h"

#include "haptics/error.h"

#include <cmath>

namespace palp::fem
{
namespace
{

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

double MeshCheck::changeOnHalving(double force, double depth, const std::stop_token& stop)
{
  try
  {
    if (!lost_)
    {
      indenter_.press(depth, stop);
      return kNextChange * std::abs(indenter_.state().force / force - 1.0);
    }
  }
  catch (const Error&)
  {
    lost_ = true;
  }
  return HUGE_VAL;
}

} // namespace palp::fem
