#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/force_law.h"
#include "haptics/servo/scene.h"
#include "haptics/surface/sampling/place_grid.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palp
{

/// Presses of one depth, spread over a surface.
struct MapRequest
{
  double depth = 5e-3;               ///< of each contact [m]
  double spacing = 10e-3;            ///< of the places [m]
  std::optional<MapRegion> region{}; ///< none: the whole surface
};

constexpr double kLeastSpacing = 0.5e-3; ///< [m]
constexpr double kMostSpacing = 0.2;     ///< [m]

/// A place of a map, and what was felt there.
struct MapPlace
{
  SurfacePoint point;
  bool isPressed = false; ///< else the tool does not get as deep there
  Response response{};    ///< of the law, without damping and what is before it in time
  Contact contact{};
};

struct StiffnessMap
{
  MapRequest asked;
  Scene scene; ///< that was pressed
  std::vector<MapPlace> places;

  /// How many could be pressed.
  [[nodiscard]] std::size_t pressed() const noexcept;

  /// Whether its numbers are those of another scene, too: surface, tool, tissue, law.
  [[nodiscard]] bool holdsIn(const Scene& other) const;
};

/// Presses each place as `palp run --at` does: along the inward normal, until the contact is as
/// deep as asked, at rest. The law and the contact are those of the servo thread.
///
/// @param scene  with the surface and the tool
/// @param goOn   told how many places are done, of how many; false ends the work
/// @return       the places so far
/// @throws Error BadValue: as placeGrid, or a depth or spacing out of range
[[nodiscard]] StiffnessMap pressMap(const Scene& scene, const MapRequest& request,
  const std::function<bool(std::size_t done, std::size_t all)>& goOn);

/// Stiffness dF/ddepth [N/m] at points of the surface, by places of the same side that are within
/// twice the spacing; at a place itself its own.
///
/// @return  one per point; NaN where the nearest place could not be pressed, or none is within a
///          quarter more than the spacing
/// @source  Franke and Nielson, International Journal for Numerical Methods in Engineering 15,
/// 1980: Shepard's weights, bounded
[[nodiscard]] std::vector<double> stiffnessAt(
  const StiffnessMap& map, std::span<const SurfacePoint> points);

} // namespace palp
