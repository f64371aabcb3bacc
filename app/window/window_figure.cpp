// Figures of the press and curves, drawn by another program while the window goes on.

#include "app/folder/export_folder.h"
#include "app/graphs/figure_dialog.h"
#include "app/graphs/plot_panel.h"
#include "app/plots/chart_job.h"
#include "app/plots/figure_job.h"
#include "app/shell/child_program.h"
#include "app/window/exported.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"
#include "pipeline/charts/plot_files.h"

#include <QTemporaryDir>

namespace palp
{
namespace
{

// what the other program makes of a folder
void drawInto(const QString& what, const std::filesystem::path& made,
  const std::filesystem::path& to,
  const std::function<void(const std::filesystem::path& folder)>& fill)
{
  const QTemporaryDir folder;
  if (!folder.isValid())
  {
    throw Error(ErrorCode::BadFile, "no temporary folder can be made; free some space in /tmp");
  }
  const std::filesystem::path stage = folder.path().toStdString();
  fill(stage);
  throwUnlessWell(runProgram("palp-draw", { what, folder.path() }));
  replaceFile(to, readText(stage / made, "what was drawn"));
}

void drawFigure(const std::filesystem::path& to, const Exported& made, const std::string& job)
{
  drawInto("--figure", kFigureMade, to,
    [&](const std::filesystem::path& stage)
    {
      writeScene(stage, made.plan, "");
      writeProvenance(stage, made.plan, made.recording);
      replaceFile(stage / kFigureJob, job);
    });
}

void drawCurves(const std::filesystem::path& to, const std::string& job)
{
  drawInto("--charts", kChartsMade + to.extension().string(), to,
    [&](const std::filesystem::path& stage) { replaceFile(stage / kChartJob, job); });
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
  std::function<void()> save;
  const auto prepare = [&]
  {
    if (!file.endsWith(".png", Qt::CaseInsensitive))
    {
      throw Error(
        ErrorCode::BadFile, file.toStdString() + ": a figure is written as PNG; end it in .png");
    }
    const SurfaceMap* map = shownMap();
    const FigureJob job{ .size = size,
      .look = look,
      .camera = cameraPlace(),
      .sample = moment.value_or(shown_),
      .map = map != nullptr ? std::optional(*map) : std::nullopt };
    Exported made = exported(pictured());
    made.parts.clear(); // of which it shows one moment
    save = [this, file, size, made = std::move(made), job = pack(job)]
    {
      const auto written = inBackground<bool>(tr("Saving the figure"),
        [to = file.toStdString(), made, job]
        {
          drawFigure(to, made, job);
          return true;
        });
      say(written ? tr("Written to %1: %2 x %3 pixels").arg(file).arg(size.width).arg(size.height)
                  : tr("No figure: it was canceled"));
    };
  };
  return attempt(prepare) && saveInTurn(save);
}

// of curves; a file of numbers is no picture, and written at once
void Window::writeCurves(const QString& file, const Plots& plots, std::optional<ImageSize> size)
{
  const std::filesystem::path to = file.toStdString();
  if (plots.empty())
  {
    throw Error(ErrorCode::BadValue, "nothing to save yet: press the surface");
  }
  if (to.extension() == ".csv")
  {
    writeCsv(plots, to);
    say(tr("Written to %1: all curves as drawn; each millisecond is in the samples.csv of Export "
           "data")
          .arg(file));
    return;
  }
  const ChartSheet sheet = ChartSheet::of(plots, to, size);
  const auto save = [this, file, to, sheet, job = pack(sheet, plots)]
  {
    const auto written = inBackground<bool>(tr("Saving the curves"),
      [to, job]
      {
        drawCurves(to, job);
        return true;
      });
    const QString pixels = tr("Written to %1: %2 x %3 pixels");
    const QString points = tr("Written to %1: lines and text, %2 x %3 points");
    say(written ? (sheet.ending == ".png" ? pixels : points)
                    .arg(file)
                    .arg(sheet.size.width)
                    .arg(sheet.size.height)
                : tr("No curves: it was canceled"));
  };
  background_.isBusy() ? void(saveInTurn(save)) : saves_.write(save);
}

bool Window::savePlots(const QString& file, std::optional<ImageSize> size)
{
  return attempt([&] { writeCurves(file, plots_->plots(), size); });
}

bool Window::saveCurves(const QString& file)
{
  return attempt(
    [&]
    {
      charts_->refresh();
      writeCurves(file, charts_->plots(), std::nullopt);
    });
}

bool Window::saveChart(std::size_t chart, const QString& file, ImageSize size)
{
  return attempt(
    [&]
    {
      charts_->refresh();
      Plots plots = charts_->plots();
      Plots one;
      one.push_back(std::move(plots.at(chart)));
      writeCurves(file, one, size);
    });
}

} // namespace palp
