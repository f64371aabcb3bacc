#include "data/liver_mesh.h"

#include "data/contour.h"
#include "data/liver.h"
#include "haptics/units.h"

namespace palp
{

using namespace units::literals;

Mesh makeLiver(double edge)
{
  constexpr double spacing = 2.0_mm; // finer than the notches
  return contoured(liverDistance, { -125.0_mm, -55.0_mm, -90.0_mm }, { 125.0_mm, 55.0_mm, 90.0_mm },
    spacing, edge);
}

} // namespace palp
