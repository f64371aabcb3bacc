#include "haptics/devices/identify/identify.h"
#include "haptics/error.h"

#include <algorithm>
#include <array>

namespace palp
{

double forceScale(const IdentifiedArm& without, const IdentifiedArm& with, double added)
{
  std::array<double, 3> more{};
  for (std::size_t i = 0; i < more.size(); ++i)
  {
    more[i] = with.axes[i].mass - without.axes[i].mass;
    if (!(more[i] > 0.15 * without.axes[i].mass))
    {
      throw Error(ErrorCode::BadValue,
        "identify: the arm is not noticeably heavier with the added mass; fix a larger one to it");
    }
  }
  std::ranges::sort(more);
  return added / more[1];
}

} // namespace palp
