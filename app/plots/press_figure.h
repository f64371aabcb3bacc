#pragma once

#include "app/input/scene_plan.h"
#include "app/press/body.h"
#include "app/press/calibration.h"
#include "app/press/recording.h"
#include "haptics/servo/sample.h"
#include "pipeline/figure/balls.h"
#include "pipeline/figure/other_hand.h"
#include "pipeline/figure/surroundings.h"
#include "pipeline/model/overlay.h"
#include "pipeline/view/press_view.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

class vtkPolyData;
class vtkRenderWindow;

namespace palp
{

/// A press at one moment, to be drawn.
struct PressMoment
{
  const SceneBody& body;
  const ForceLaw& law;
  const Calibration& calibration;
  const Sample& sample;
  const SurfaceMap* map = nullptr; ///< colors of the body; null: its own
  appearance::Color color = appearance::kLiver;
  std::vector<Surrounding> around{};
  const Sample* second = nullptr; ///< of another hand at that time; null: there is none
  vtkPolyData* drawn = nullptr;   ///< in the place of the body's surface; null: that one
};

/// As a translucent body shows them.
[[nodiscard]] std::vector<Balls::Ball> ballsOf(std::span<const PlacedNodule> nodules);

/// That of a sample in a recording: of several organs, the one that it tells of amid the others.
/// @param isQuick  by the coarse level of each body that has one, but where a map is of all points
[[nodiscard]] PressMoment momentOf(const SceneBody& body, const Recording& recording,
  const Calibration& calibration, const Sample& sample, const SurfaceMap* map = nullptr,
  bool isQuick = false);

/// What a figure of it has beside the body, the tool and their dent.
struct FigureLook
{
  bool isTransparent = false; ///< no background
  bool hasColorBar = true;
  bool hasAxes = false;     ///< those of the scene, by the patient's sides where they are known
  bool hasScaleBar = false; ///< true at the contact
  bool hasCaption = false;  ///< tool, tissue, law, depth and force
  bool isRealistic = false; ///< wet, and darker where little light comes; takes a second
  std::vector<Overlay> overlays{};
  BodyLook body{};
};

/// A view with all that a moment has but its sample.
void prepareView(PressView& view, Surroundings& around, const PressMoment& moment);

/// A view as it is drawn for a moment.
void showMoment(PressView& view, OtherHand& other, Surroundings& around, const PressMoment& moment);

/// Whether the coordinates are a patient's: x to the left, y to the back, z to the head.
[[nodiscard]] bool isPatient(const SceneBody& body);

/// Tool, tissue and law, for people.
[[nodiscard]] std::string toolAndTissue(const ForceLaw& law);

/// Tool, tissue, law, depth and force; of a map what that comes from, and the press where there is
/// one.
[[nodiscard]] std::string captionOf(const PressMoment& moment);

/// The dots per inch at which a picture has the letters and lines of a smaller one, larger.
[[nodiscard]] int dpiOf(ImageSize size);

using ViewUse = std::function<void(PressView& view, vtkRenderer& renderer)>;

using FigureUse = std::function<void(
  PressView& view, OtherHand& other, Surroundings& around, vtkRenderer& renderer)>;

/// Shows a press in a window of no renderers yet, as large as the picture, while it is used.
///
/// Edges are smooth: several samples for each pixel, or in a picture too large for that a filter.
/// @param look  places the camera; labels follow it
/// @param use   draws it, once or after changes
void drawFigure(vtkRenderWindow& window, const PressMoment& moment, const FigureLook& figure,
  const ViewUse& look, const FigureUse& use);

/// The same, written once.
/// @param file    .png
/// @throws Error  as writePng
void writeFigure(vtkRenderWindow& window, const PressMoment& moment, const FigureLook& figure,
  const ViewUse& look, const std::filesystem::path& file);

} // namespace palp
