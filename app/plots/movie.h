#pragma once

#include "app/input/scene_plan.h"
#include "haptics/servo/sample.h"

#include <span>
#include <vector>

namespace palp
{

constexpr int kMovieRate = 25; ///< [frames/s]

/// One picture of a movie.
struct MovieFrame
{
  const Sample* sample = nullptr; ///< of the recording
  double turn = 0.0; ///< of the camera about the upright through what it looks at [rad]
};

/// The pictures of a movie in their order: a replay takes as long as the press did, a turn takes
/// 6 s.
///
/// @param samples  in the order of their times, at least one
/// @param shown    the one that a turntable shows, of these
[[nodiscard]] std::vector<MovieFrame> movieFrames(
  MovieKind kind, std::span<const Sample> samples, const Sample& shown);

} // namespace palp
