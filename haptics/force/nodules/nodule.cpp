#include "haptics/force/nodules/nodule.h"

#include "haptics/error.h"
#include "haptics/units.h"

namespace palp
{
namespace
{

using namespace units::literals;

void check(double value, double least, double most, const std::string& message)
{
  if (!(value >= least && value <= most)) // NaN, too
  {
    throw Error(ErrorCode::BadValue, message);
  }
}

} // namespace

Nodule checkedNodule(const Nodule& nodule, const std::string& what)
{
  check(
    nodule.radius, 0.1_mm, 100.0_mm, what + ": the radius is out of range; give 0.1mm to 100mm");
  check(nodule.top, 10.0_um, 1000.0_mm,
    what + ": its highest point must lie below the surface; give a depth of 0.01mm to 1m");
  check(nodule.ratio, 0.2, 50.0,
    what + ": the ratio of its stiffness to that of the tissue is out of range; give 0.2 to 50");
  return nodule;
}

} // namespace palp
