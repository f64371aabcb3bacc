#pragma once

#include "app/input/press_places.h"
#include "app/press/press_log.h"
#include "app/press/recording.h"

#include <optional>
#include <string>

namespace palp
{

/// @param asked     organ that the place is on, as in a Sample
/// @param start     the tool before it presses there
/// @throws Error    BadValue: it is within another organ
void checkStart(
  const PressPlace& place, int asked, const ToolPose& start, const Recording& recording);

/// What there is to tell of a press of which the tool met another organ than that of its place, as
/// it is nearer or wider; empty: nothing.
[[nodiscard]] std::string noteOfOrgan(
  const PressPlace& place, const std::string& asked, const std::string& met);

/// The press at a place that a live session makes next, until it tells which organ it met.
class AwaitedPress
{
public:
  /// @param presses   at one place
  /// @throws Error    BadValue: as pathsOf, checkStart
  void begin(const PlacedPresses& presses, const Recording& recording, const PressLog& log);

  /// Once it is kept, or will not come any more.
  /// @return  as noteOfOrgan; empty after that
  [[nodiscard]] std::string end(const PressLog& log);

private:
  std::optional<PressPlace> place_; // none: nothing is awaited
  std::string asked_;
  int before_ = 0; // press that was kept last
};

} // namespace palp
