#pragma once

#include "app/body.h"
#include "app/recording.h"
#include "calibration/experiments.h"
#include "calibration/study.h"

#include <filesystem>

namespace palp
{

struct ImageSize
{
  int width = 1280;
  int height = 960;
};

/// What the program that carries rendering can draw. Commands ask through this, so that they
/// are the same code in every program.
struct Pictures
{
  virtual ~Pictures() = default;

  /// Draws press.png (the deepest moment), force_time.png and force_depth.png.
  ///
  /// @throws Error  NoPicture: no context, or a picture that came out empty
  virtual void drawPress(const Body& body, const Recording& recording,
    const Calibration& calibration, const std::filesystem::path& directory,
    ImageSize size) const = 0;

  /// Draws extent.png, force.png and profiles.png of a calibration.
  ///
  /// @param steps   fewer than two: nothing is drawn
  /// @throws Error  as drawPress
  virtual void drawCalibration(const fem::Case& study, const std::vector<fem::Indented>& steps,
    const std::filesystem::path& directory) const = 0;

  /// Draws a picture of every figure of an experiment.
  ///
  /// @throws Error  as drawPress
  virtual void drawExperiment(
    const fem::Experiment& experiment, const std::filesystem::path& directory) const = 0;
};

} // namespace palp
