#pragma once

#include "app/calibration.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace palp
{

/// A finished press: who pressed what, and everything that was measured.
struct Recording
{
  std::string mesh;   ///< file name, for people
  std::string unit;   ///< that its coordinates were read in
  std::string device; ///< hand, mouse, path:NAME
  Scene scene;
  std::vector<Sample> samples;
  bool rated = true; ///< how far each sample may be believed is told, too

  /// The first sample of the largest depth; nothing when the tool never touched.
  [[nodiscard]] const Sample* deepest() const noexcept;
};

/// Writes samples.csv: a header of comment lines, the column names with units, one row per sample.
///
/// The same recording gives the same bytes: no date, no host.
///
/// @param calibration  R_d(depth) for the column extent_radius_mm, 0 when apart; null: no such
/// column
void writeSamples(std::ostream& out, const Recording& recording, const Calibration* calibration);

} // namespace palp
