#pragma once

#include "app/headless/renderer.h"

namespace palp
{

/// Draws off screen, without any display server.
class OffscreenRenderer final : public Renderer
{
public:
  void drawPress(const SceneBody& body, const Recording& recording, const Calibration* calibration,
    const ScenePlan& plan, const std::filesystem::path& directory) const override;
  void drawCalibration(const fem::Case& study, const std::vector<fem::IndentationStep>& steps,
    const std::filesystem::path& directory) const override;
  void drawFigures(std::span<const figures::Figure> figures, std::span<const figures::Table> tables,
    figures::Layout layout, const std::filesystem::path& directory) const override;
  [[nodiscard]] std::vector<BenchRow> benchFrames(std::size_t most, int frames) const override;
};

} // namespace palp
