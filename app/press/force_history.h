#pragma once

#include "haptics/force/relaxation/contact_rows.h"
#include "haptics/force/relaxation/press_history.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace palp
{

/// A press that was recorded or made up: depths of a tool over time.
struct ForceHistory
{
  std::vector<PressPoint> points{}; ///< one at least
  std::vector<double> depthsMm{};   ///< as the file has them

  /// [m]
  [[nodiscard]] double deepest() const noexcept;
};

/// Reads a CSV whose header names time_s and depth_mm among any others.
///
/// @throws Error  BadFile: as NumberTable::readRecording; no row, times that do not increase, a
///                depth beyond 1 m
[[nodiscard]] ForceHistory readForceHistory(const std::filesystem::path& file);

/// The force at each point of a history, at one place.
/// @param elastic     of the instantaneous modulus, at a depth [m] of 0 or more
/// @param relaxation  of all that lies below alike
/// @return            [N]
[[nodiscard]] std::vector<double> forcesOver(const std::function<ElasticForce(double)>& elastic,
  const PronySeries& relaxation, const ForceHistory& history);

} // namespace palp
