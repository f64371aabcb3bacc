// Figures of the press, drawn by another program while the window goes on.

#include "app/folder/export_folder.h"
#include "app/graphs/figure_dialog.h"
#include "app/plots/figure_job.h"
#include "app/window/child_program.h"
#include "app/window/exported.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <QTemporaryDir>

namespace palp
{
namespace
{

// of what is drawn, without the samples, which may be many
Recording withoutSamples(const Recording& recording)
{
  return { .mesh = recording.mesh,
    .unit = recording.unit,
    .device = recording.device,
    .files = recording.files,
    .command = recording.command,
    .organs = recording.organs,
    .scene = recording.scene,
    .rated = recording.rated };
}

void drawFigure(const std::filesystem::path& to, const Exported& made, const std::string& job)
{
  const QTemporaryDir folder;
  if (!folder.isValid())
  {
    throw Error(ErrorCode::BadFile, "no temporary folder can be made; free some space in /tmp");
  }
  const std::filesystem::path stage = folder.path().toStdString();
  writeScene(stage, made.plan, "");
  writeProvenance(stage, made.plan, made.recording);
  replaceFile(stage / kFigureJob, job);
  throwUnlessWell(runProgram("palp-draw", { "--figure", folder.path() }));
  replaceFile(to, readText(stage / kFigureMade, "the figure"));
}

} // namespace

void Window::askFigure()
{
  const Sample asked = shown_; // a dialog takes the pointer, and the tool lifts
  FigureDialog dialog(tr("Save figure"), "press_figure.png", tr("PNG (*.png)"), ImageSize{}, this);
  FigureLook look{
    .hasAxes = true, .hasScaleBar = true, .isRealistic = true, .body = view_.look()
  };
  for (std::size_t i = 0; i < kOverlayCount; ++i)
  {
    if (const auto overlay = static_cast<Overlay>(i); view_.isVisible(overlay))
    {
      look.overlays.push_back(overlay);
    }
  }
  dialog.offerParts(look);
  if (dialog.exec() == QDialog::Accepted)
  {
    saveFigure(dialog.file(), dialog.size(), dialog.look(), asked);
  }
}

bool Window::saveFigure(
  const QString& file, ImageSize size, const FigureLook& look, const std::optional<Sample>& moment)
{
  return attempt(
    [&]
    {
      if (!file.endsWith(".png", Qt::CaseInsensitive))
      {
        throw Error(
          ErrorCode::BadFile, file.toStdString() + ": a figure is written as PNG; end it in .png");
      }
      const Pictured seen = pictured();
      const SurfaceMap* map = shownMap();
      const FigureJob job{ .size = size,
        .look = look,
        .camera = cameraPlace(),
        .sample = moment.value_or(shown_),
        .map = map != nullptr ? std::optional(*map) : std::nullopt };
      const Recording head = withoutSamples(seen.recording);
      const auto written = inBackground<bool>(tr("Saving the figure"),
        [to = file.toStdString(), made = exported({ seen.body, head, seen.calibration }),
          job = pack(job)]
        {
          drawFigure(to, made, job);
          return true;
        });
      say(written ? tr("Written to %1: %2 x %3 pixels").arg(file).arg(size.width).arg(size.height)
                  : tr("No figure: it was canceled"));
    });
}

} // namespace palp
