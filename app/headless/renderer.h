#pragma once

#include "app/bench/bench.h"
#include "app/press/body.h"
#include "app/press/recording.h"
#include "calibration/figures/figure.h"
#include "calibration/study/study.h"

#include <filesystem>
#include <span>

namespace palp
{

/// What the program that carries rendering can draw. Commands ask through this, so that they
/// are the same code in every program.
struct Renderer
{
  virtual ~Renderer() = default;

  /// Draws what the plan asks for of press.png (the deepest moment), movies, force_time.png and
  /// force_depth.png.
  ///
  /// @param calibration  null only where the plan has no press.png and no movie
  /// @throws Error  NoPicture: no context, or a picture that came out empty
  virtual void drawPress(const SceneBody& body, const Recording& recording,
    const Calibration* calibration, const ScenePlan& plan,
    const std::filesystem::path& directory) const = 0;

  /// Draws extent.png, force.png and profiles.png of a calibration.
  ///
  /// @param steps   fewer than two: nothing is drawn
  /// @throws Error  as drawPress
  virtual void drawCalibration(const fem::Case& study,
    const std::vector<fem::IndentationStep>& steps,
    const std::filesystem::path& directory) const = 0;

  /// Draws NAME.png of every figure that stands alone, NAME.svg of one on a page.
  ///
  /// @param tables  all that the figures name
  /// @throws Error  as drawPress
  virtual void drawFigures(std::span<const figures::Figure> figures,
    std::span<const figures::Table> tables, figures::Layout layout,
    const std::filesystem::path& directory) const = 0;

  /// What a moved dent costs a picture beyond drawing the same scene again, upload included.
  ///
  /// @param most    points of the largest surface
  /// @param frames  pictures of each kind
  /// @throws Error  as drawPress
  [[nodiscard]] virtual std::vector<BenchRow> benchFrames(std::size_t most, int frames) const = 0;
};

} // namespace palp
