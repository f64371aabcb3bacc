#include "haptics/contact/contact_geometry_of.h"

#include "haptics/contact/find_contact.h"

namespace palp
{

ContactGeometry geometryAt(
  const Surface& surface, const Tip& tip, const SurfacePoint& place) noexcept
{
  constexpr double kProbe = 0.05; // depth over base radius
  const ToolPose pose{ .apex = place.position - kProbe * baseRadius(tip) * place.normal,
    .axis = -place.normal };
  ContactGeometry geometry = contactGeometryOf(findContact(surface, tip, pose, ContactRule::Exact));
  geometry.tilt = 0.0;
  geometry.depth = 0.0;
  return geometry;
}

} // namespace palp
