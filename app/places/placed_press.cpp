#include "app/places/placed_press.h"

#include "app/input/quantity.h"
#include "haptics/contact/find_contact.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/numerics/roots.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/ray.h"
#include "haptics/surface/surface_point.h"
#include "haptics/tip/tip.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <sstream>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kAbove = 1.0_mm; // of the tool before and after
constexpr double kRest = 0.1;     // at the depth [s]
constexpr double kAside = 0.2;    // of the base of a tool: as near to its place it touches the body

std::string inWords(const Eigen::Vector3d& place)
{
  std::ostringstream text;
  text.precision(4);
  text << units::toMillimeters(place.x()) << "," << units::toMillimeters(place.y()) << ","
       << units::toMillimeters(place.z());
  return text.str();
}

[[noreturn]] void refusePlace(const PressPlace& place, const std::string& what)
{
  throw Error(ErrorCode::BadValue, "the place " + inWords(place) + ": " + what);
}

struct OnTriangle
{
  int triangle;
  Eigen::Vector3d position;
};

// where the line from the place first meets the surface
OnTriangle alongLine(const PressPlace& place, const Eigen::Vector3d& toward, const Surface& surface)
{
  const Eigen::Vector3d direction = toward.normalized();
  const RayHit hit = rayEntry(surface.tree(), place.position, direction);
  if (hit.triangle < 0)
  {
    refusePlace(place,
      "the line from there along --toward does not meet the surface from outside; move it, or turn "
      "it around");
  }
  return { hit.triangle, place.position + hit.distance * direction };
}

OnTriangle ontoSurface(const PressPlace& place, const Surface& surface)
{
  const ClosestPoint nearest =
    findClosestPoint(surface, place.position, std::numeric_limits<double>::infinity());
  const double off = (nearest.point - place.position).norm();
  if (!(off <= kFarthestPlace))
  {
    std::ostringstream text;
    text.precision(3);
    text << units::toMillimeters(off) << " mm off the surface, whose nearest point is "
         << inWords(nearest.point) << " mm; give a place within "
         << units::toMillimeters(kFarthestPlace) << " mm of it, in the frame of the mesh";
    refusePlace(place, text.str());
  }
  return { nearest.triangle, nearest.point };
}

// The normal that the tool feels at its depth. Those of a triangle's corners, as of a picture, lean
// over the edges of a body of few triangles, and would lead the tool aside.
SurfacePoint feltPoint(const OnTriangle& place, double depth, const Scene& scene)
{
  const Surface& surface = *scene.surface;
  const Triangle& corners = surface.triangles()[static_cast<std::size_t>(place.triangle)];
  const auto corner = [&](std::size_t k)
  { return surface.points()[static_cast<std::size_t>(corners[k])]; };
  const Eigen::Vector3d facet = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  const auto feltAlong = [&](const Eigen::Vector3d& normal)
  {
    return findContact(surface, scene.law.tip(),
      { .apex = place.position - depth * normal, .axis = -normal }, ContactRule::Exact,
      curvatureOf(scene));
  };
  const Eigen::Vector3d felt = feltAlong(facet).normal;
  // neither through to the other side, nor of what stands beside it
  const bool isThere =
    felt.dot(facet) > 0.0 && feltAlong(felt).depth < depth + kAside * baseRadius(scene.law.tip());
  return { place.position, isThere ? felt : facet };
}

// a tool that is moved along the inward normal, by a travel from the place on
class Descent
{
public:
  /// @param all    in which it is free
  /// @param organ  of these that is pressed
  Descent(const Scene& all, int organ, const SurfacePoint& point)
    : all_(all)
    , organ_(organ)
    , point_(point)
  {
  }

  [[nodiscard]] Eigen::Vector3d apexAt(double travel) const
  {
    return point_.position - travel * point_.normal;
  }

  // in one organ
  [[nodiscard]] double depthAt(double travel, int organ) const noexcept
  {
    return findContact(organOf(all_, organ), { .apex = apexAt(travel), .axis = -point_.normal })
      .depth;
  }

  // an organ that the tool is in, that which is pressed before others; nothing: it is free
  [[nodiscard]] std::optional<int> touchedAt(double travel) const noexcept
  {
    std::optional<int> touched;
    for (int i = 0; i < organCount(all_) && touched != organ_; ++i)
    {
      touched = depthAt(travel, i) > 0.0 && (!touched || i == organ_) ? i : touched;
    }
    return touched;
  }

  // the last travel at which the tool is free, or the farthest
  [[nodiscard]] double freeAt() const
  {
    const double farthest = -2.0 * baseRadius(all_.law.tip());
    double travel = 0.0;
    while (touchedAt(travel) && travel >= farthest)
    {
      travel -= kAbove;
    }
    return travel;
  }

  // where a contact gets as deep as asked; nothing: the tool cannot get that deep
  [[nodiscard]] std::optional<double> travelTo(double depth, double from) const
  {
    const double step = 0.02 * depth; // past a thin part's middle the depth falls again
    double high = depth;
    while (!(depthAt(high, organ_) >= depth))
    {
      high += step;
      if (high > 2.0 * depth + kAbove)
      {
        return std::nullopt;
      }
    }
    constexpr int kHalvings = 60;
    return bisect(
      [&](double travel) { return depthAt(travel, organ_) < depth; }, { from, high }, kHalvings)
      .high;
  }

  // how far from the place the contact is
  [[nodiscard]] double asideAt(double travel) const
  {
    return (findContact(organOf(all_, organ_), { .apex = apexAt(travel), .axis = -point_.normal })
              .center -
      point_.position)
      .norm();
  }

private:
  const Scene& all_;
  int organ_;
  SurfacePoint point_;
};

SurfacePoint pointOn(const PressPlace& place, const PlacedPresses& presses, const Scene& organ)
{
  SurfacePoint point = feltPoint(presses.toward ? alongLine(place, *presses.toward, *organ.surface)
                                                : ontoSurface(place, *organ.surface),
    presses.depth, organ);
  const double thickness = rayExit(organ.surface->tree(), point.position, -point.normal).distance;
  if (presses.depth > 0.5 * thickness)
  {
    refusePlace(place,
      "a depth of " + quantityText(presses.depth, Quantity::Length) + " is more than half of the " +
        units::inMillimeters(thickness) + " that the body is thick there; give less");
  }
  return point;
}

// how far a press leads from its place, along the inward normal
struct Travel
{
  Descent descent;
  Eigen::Vector3d axis;
  double start;
  double bottom;
};

Travel travelOf(const PressPlace& place, const PlacedPresses& presses, const Scene& scene)
{
  const int organ = organAt(place, presses, scene);
  const SurfacePoint point = pointOn(place, presses, organOf(scene, organ));
  const Descent descent(scene, organ, point);
  const double free = descent.freeAt();
  if (descent.touchedAt(free) == organ || descent.touchedAt(free - kAbove) == organ)
  {
    refusePlace(place, "the tool does not fit there; give another place, or a smaller tool");
  }
  const std::optional<double> bottom = descent.travelTo(presses.depth, free);
  if (!bottom)
  {
    refusePlace(place,
      "the tool gets no contact of " + quantityText(presses.depth, Quantity::Length) +
        " there; give less, another place, or a smaller tool");
  }
  if (const double aside = descent.asideAt(*bottom); aside > kAside * baseRadius(scene.law.tip()))
  {
    refusePlace(place,
      "the tool touches the body " + units::inMillimeters(aside) +
        " beside it, and not there; give another place, or a smaller tool");
  }
  return { descent, -point.normal, free - kAbove, *bottom };
}

ScriptedPath pathOf(const PressPlace& place, const PlacedPresses& presses, const Scene& scene)
{
  const auto [descent, axis, start, bottom] = travelOf(place, presses, scene);
  const double down = (bottom - start) / presses.speed;
  std::vector<PathKnot> knots;
  for (const auto& [time, travel] : { std::pair(0.0, start), std::pair(down, bottom),
         std::pair(down + kRest, bottom), std::pair(2.0 * down + kRest, start) })
  {
    knots.push_back({ .time = time, .apex = descent.apexAt(travel), .axis = axis });
  }
  return ScriptedPath(std::move(knots));
}

} // namespace

std::string inWords(const PressPlace& place)
{
  return (place.name.empty() ? "" : printable(place.name) + ", ") + inWords(place.position) + " mm";
}

SurfacePoint pressedPoint(const PressPlace& place, const PlacedPresses& presses, const Scene& scene)
{
  return pointOn(place, presses, organOf(scene, organAt(place, presses, scene)));
}

// of several organs that which the line meets first, or whose surface is nearest
int organAt(const PressPlace& place, const PlacedPresses& presses, const Scene& scene)
{
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const auto distanceTo = [&](int organ)
  {
    const Surface& surface = *organOf(scene, organ).surface;
    return presses.toward
      ? rayEntry(surface.tree(), place.position, presses.toward->normalized()).distance
      : (findClosestPoint(surface, place.position, kAnywhere).point - place.position).norm();
  };
  const auto all = std::views::iota(0, organCount(scene));
  return *std::ranges::min_element(all, {}, distanceTo);
}

ToolPose pressedPose(const PressPlace& place, const PlacedPresses& presses, const Scene& scene)
{
  const Travel travel = travelOf(place, presses, scene);
  return { .apex = travel.descent.apexAt(travel.bottom), .axis = travel.axis };
}

std::vector<ScriptedPath> pathsOf(const PlacedPresses& presses, const Scene& scene)
{
  std::vector<ScriptedPath> paths;
  for (const PressPlace& place : presses.places)
  {
    paths.push_back(pathOf(place, presses, scene));
  }
  return paths;
}

} // namespace palp
