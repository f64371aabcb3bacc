#pragma once

#include "app/input/press_places.h"
#include "app/press/recording.h"

#include <string>

namespace palp
{

/// What there is to tell of a press of which the tool meets another organ than that of its place,
/// as it is nearer or wider; empty: nothing.
///
/// @param recording  with the scene and the names of its organs
/// @throws Error     BadValue: as pathsOf; it would begin within another organ
[[nodiscard]] std::string noteOfOrgan(
  const PressPlace& place, const PlacedPresses& presses, const Recording& recording);

} // namespace palp
