#pragma once

#include "app/input/press_places.h"
#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/servo/scene.h"
#include "haptics/surface/surface_point.h"

#include <string>
#include <vector>

namespace palp
{

constexpr double kFarthestPlace = 5e-3; ///< of a place that is meant to be on the surface [m]

/// The point of the surface that a place stands for, with the normal along which a tool is pressed
/// there.
///
/// @param presses  their depth and direction
/// @param scene    with the surface and the tool; of several organs the nearest is pressed, or the
///                 first along the direction
/// @throws Error   BadValue: as pathsOf, but for the fit of the tool
[[nodiscard]] SurfacePoint pressedPoint(
  const PressPlace& place, const PlacedPresses& presses, const Scene& scene);

/// The tool at rest at a place, with the contact as deep as asked; see pathsOf.
/// @throws Error  BadValue: as pathsOf
[[nodiscard]] ToolPose pressedPose(
  const PressPlace& place, const PlacedPresses& presses, const Scene& scene);

/// Its name and position, for people.
[[nodiscard]] std::string inWords(const PressPlace& place);

/// Which organ of a scene a place stands for, as in a Sample; see pressedPoint.
[[nodiscard]] int organAt(
  const PressPlace& place, const PlacedPresses& presses, const Scene& scene);

/// The motion of each press: from 1 mm above the surface along the inward normal of the point that
/// is nearest to the place, until the contact is as deep as asked; 0.1 s of rest; and back. Begins
/// at time 0.
///
/// @param scene   with the surface and the tool
/// @throws Error  BadValue: names the place; too far off the surface, deeper than half the body's
///                thickness there, or the tool does not fit there
[[nodiscard]] std::vector<ScriptedPath> pathsOf(const PlacedPresses& presses, const Scene& scene);

} // namespace palp
