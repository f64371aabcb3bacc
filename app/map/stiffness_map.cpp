#include "app/map/stiffness_map.h"

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "app/places/placed_press.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/servo/servo_step.h"
#include "haptics/surface/sampling/point_cells.h"
#include "haptics/units.h"

#include <algorithm>
#include <limits>

namespace palp
{
namespace
{

void check(const MapRequest& request)
{
  if (!(request.spacing >= kLeastSpacing && request.spacing <= kMostSpacing))
  {
    throw Error(ErrorCode::BadValue,
      "spacing: " + units::inMillimeters(request.spacing) + " is out of range; give 0.5 to 200 mm");
  }
  if (!(request.depth > 0.0) || (request.region && !(request.region->radius > 0.0)))
  {
    throw Error(ErrorCode::BadValue, "the depth and the radius of a map must be above 0");
  }
}

MapPlace pressed(const SurfacePoint& point, double depth, const Scene& scene)
{
  MapPlace place{ .point = point };
  try
  {
    const ToolPose pose = pressedPose({ .position = point.position }, { .depth = depth }, scene);
    const Sample sample = evaluateContact(scene, pose);
    place.isPressed = sample.contact.touching();
    place.response = sample.response;
    place.contact = sample.contact;
  }
  catch (const Error&) // too thin there, or no room for the tool: a gap of the map
  {
    place.isPressed = false;
  }
  return place;
}

std::string lawOf(const Scene& scene)
{
  const Material& tissue = scene.law.material();
  return describeTip(scene.law.tip()) + ' ' + shortest(tissue.youngModulus) + ' ' +
    shortest(tissue.poissonRatio) + ' ' + describeLaw(scene.law.settings());
}

} // namespace

std::size_t StiffnessMap::pressed() const noexcept
{
  return static_cast<std::size_t>(std::ranges::count(places, true, &MapPlace::isPressed));
}

bool StiffnessMap::holdsIn(const Scene& other) const
{
  return scene.surface == other.surface && scene.rule == other.rule &&
    (scene.stiffness == nullptr) == (other.stiffness == nullptr) && lawOf(scene) == lawOf(other);
}

StiffnessMap pressMap(const Scene& scene, const MapRequest& request,
  const std::function<bool(std::size_t done, std::size_t all)>& goOn)
{
  check(request);
  StiffnessMap map{ .asked = request, .scene = scene, .places = {} };
  const std::vector<SurfacePoint> grid = placeGrid(*scene.surface, request.spacing, request.region);
  for (const SurfacePoint& point : grid)
  {
    if (!goOn(map.places.size(), grid.size()))
    {
      break;
    }
    map.places.push_back(pressed(point, request.depth, scene));
  }
  return map;
}

std::vector<double> stiffnessAt(const StiffnessMap& map, std::span<const SurfacePoint> points)
{
  constexpr double kAt = 1e-9;  // of a place [m]
  constexpr double kGap = 1.25; // that a grid may leave, in spacings
  const double reach = 2.0 * map.asked.spacing;
  PointCells cells(reach);
  for (std::size_t k = 0; k < map.places.size(); ++k)
  {
    cells.add(k, map.places[k].point.position);
  }
  std::vector<double> values;
  values.reserve(points.size());
  for (const SurfacePoint& point : points)
  {
    double sum = 0.0;
    double weights = 0.0;
    double nearest = kGap * map.asked.spacing;
    bool isKnown = false;
    cells.near(point.position,
      [&](std::size_t k)
      {
        const MapPlace& place = map.places[k];
        const double away = std::max((place.point.position - point.position).norm(), kAt);
        if (away >= reach || !areBeside(place.point, point))
        {
          return;
        }
        if (away <= nearest)
        {
          nearest = away;
          isKnown = place.isPressed;
        }
        if (place.isPressed)
        {
          const double root = (reach - away) / (reach * away);
          sum += root * root * place.response.stiffness;
          weights += root * root;
        }
      });
    values.push_back(isKnown ? sum / weights : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

} // namespace palp
