#include "haptics/contact/embed_nodules.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/error.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/surface_point.h"

#include <limits>
#include <string>

namespace palp
{
namespace
{

EmbeddedNodule embedded(
  const Surface& surface, const Tip& tip, const PlacedNodule& nodule, const std::string& name)
{
  const ClosestPoint nearest =
    findClosestPoint(surface, nodule.center, std::numeric_limits<double>::infinity());
  const double depth = -nearest.distance;
  if (nearest.triangle < 0 || !(depth > nodule.radius))
  {
    throw Error(ErrorCode::BadValue,
      name + (depth > 0.0 ? ": it stands out of the surface" : ": its center is not in the body") +
        "; move its center deeper than its radius");
  }
  const ContactGeometry place =
    geometryAt(surface, tip, surfacePoint(surface, nearest.triangle, nearest.point));
  return { .nodule = nodule, .depth = depth, .place = place };
}

} // namespace

std::shared_ptr<const NoduleField> embedNodules(
  const Surface& surface, const ForceLaw& law, std::span<const PlacedNodule> nodules)
{
  if (nodules.empty())
  {
    return nullptr;
  }
  std::vector<EmbeddedNodule> found;
  std::vector<Nodule> balls;
  std::vector<Eigen::Vector3d> places;
  for (const PlacedNodule& nodule : nodules)
  {
    const std::string name = "nodules/" + std::to_string(found.size());
    found.push_back(embedded(surface, law.tip(), nodule, name));
    balls.push_back(checkedNodule(found.back().below(), name));
    places.push_back(nodule.center);
  }
  checkApart(balls, places);
  return std::make_shared<const NoduleField>(law, std::move(found));
}

} // namespace palp
