#pragma once

#include "app/press/body.h"
#include "app/press/recording.h"
#include "haptics/servo/timing.h"
#include "pipeline/deform/dent.h"

#include <filesystem>

namespace palp
{

/// What the deformation filter needs of a sample.
[[nodiscard]] Press pressOf(const Sample& sample, const Tip& tip, const Calibration& calibration);

/// Writes the body, or of several organs the one that was pressed deepest, at that moment as VTP in
/// mm, with the arrays Displacement (mm) and Zone (0 rest, 1 ring, 2 contact); at rest when the
/// tool never touched.
///
/// @param refined  with the triangles of the dent divided until they follow it to 0.01 mm: between
///                 the points of the body's own triangles the tool shows through
/// @throws Error  BadFile: cannot be written
void writeDeformed(const std::filesystem::path& file, const SceneBody& body,
  const Recording& recording, const Calibration& calibration, bool refined = false);

/// Writes the samples into a file; see the other writeSamples.
/// @throws Error  BadFile: cannot be written
void writeSamples(
  const std::filesystem::path& file, const Recording& recording, const Calibration* calibration);

/// Writes how punctual a servo thread was: quantiles of lateness and step time [us], ticks,
/// skipped.
///
/// @throws Error  BadFile: cannot be written
void writeTiming(const std::filesystem::path& file, const Timing& timing);

} // namespace palp
