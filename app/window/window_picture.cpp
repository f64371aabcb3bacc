// How the window's picture is looked at, and saved to print.

#include "app/graphs/figure_dialog.h"
#include "app/shell/theme.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "pipeline/charts/plot_files.h"
#include "pipeline/view/appearance.h"

#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <QAction>
#include <QMenu>

#include <array>
#include <cmath>

namespace palp
{

// by the sides of a patient in LPS, which other surfaces are looked at by, too
void Window::addStandardViews(QMenu& menu)
{
  struct Standard
  {
    QString name;
    Eigen::Vector3d eye;
    Eigen::Vector3d up;
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const std::array<Standard, 6> views{ { { tr("&Anterior, from -y"), -y, z },
    { tr("&Posterior, from +y"), y, z }, { tr("&Left, from +x"), x, z },
    { tr("&Right, from -x"), -x, z }, { tr("&Superior, from +z"), z, -y },
    { tr("&Inferior, from -z"), -z, -y } } };
  QMenu* standard = menu.addMenu(tr("&Standard views"));
  int key = Qt::Key_1;
  const auto add = [&](const QString& name, const std::function<void()>& look)
  {
    standard->addAction(
      name, this,
      [this, look]
      {
        keepView();
        look();
        isStale_ = true;
      },
      QKeySequence(static_cast<int>(Qt::CTRL) | key++));
  };
  for (const Standard& view : views)
  {
    add(view.name, [this, view] { view_.lookFrom(view.eye, view.up); });
  }
  add(tr("From the &tool"),
    [this]
    {
      const Eigen::Vector3d eye = -shown_.pose.axis.normalized();
      const bool isUpright = std::abs(eye.z()) > 0.9;
      view_.lookFrom(eye, { 0.0, isUpright ? -1.0 : 0.0, isUpright ? 0.0 : 1.0 });
    });
}

// of the picture and the charts, which know no palette
void Window::takeTheme()
{
  using appearance::Color;
  const bool dark = isDark(palette());
  const Color ground = dark ? Color{ 0.16, 0.17, 0.19 } : appearance::kGround;
  const Color sky = dark ? Color{ 0.30, 0.32, 0.35 } : appearance::kSky;
  renderer_->SetBackground(ground[0], ground[1], ground[2]);
  renderer_->SetBackground2(sky[0], sky[1], sky[2]);
  orientation_.setInk(dark ? appearance::kSky : appearance::kInk);
  scaleBar_.setInk(dark ? appearance::kSky : appearance::kInk);
  isStale_ = true;
  drawCharts();
  chartsAreStale_ = true;
}

void Window::addMarks(QMenu& menu)
{
  const auto add = [&](const QString& name, const char* id, const std::function<void(bool)>& show)
  {
    QAction* action = menu.addAction(name);
    action->setObjectName(id);
    action->setCheckable(true);
    connect(action, &QAction::toggled, this,
      [this, show](bool on)
      {
        show(on);
        isStale_ = true;
      });
    action->setChecked(true);
  };
  add(tr("A&xes"), "axesAction", [this](bool on) { orientation_.setVisible(on); });
  add(tr("Scale &bar"), "scaleBarAction", [this](bool on) { scaleBar_.setVisible(on); });
}

void Window::addBodyLooks(QMenu& menu)
{
  struct Part
  {
    QString name;
    const char* id;
    bool BodyLook::*part;
    QKeySequence key = {};
  };
  for (const Part& one : { Part{ tr("&Edges of triangles"), "edgesAction", &BodyLook::hasEdges },
         { tr("See-through s&urface"), "translucentAction", &BodyLook::isTranslucent },
         { tr("Cut &open at the contact"), "cutAction", &BodyLook::isCut },
         Part{ tr("&Hide the tool"), "hideToolAction", &BodyLook::hidesTool, Qt::Key_T } })
  {
    QAction* action = menu.addAction(one.name);
    action->setObjectName(one.id);
    action->setCheckable(true);
    action->setShortcut(one.key);
    connect(action, &QAction::toggled, this,
      [this, part = one.part](bool on)
      {
        BodyLook look = view_.look();
        look.*part = on;
        view_.setLook(look);
        isStale_ = true;
      });
  }
  menu.addSeparator();
}

void Window::keepView()
{
  fittedTo_.reset();
  still_ = 0;
  setSmooth(false);
}

// what lies behind each other is seen in its order by the slow way alone
void Window::setSmooth(bool smooth)
{
  renderer_->SetUseFXAA(smooth);
  renderer_->SetPass(smooth || view_.look().isTranslucent ? nullptr : fast_.Get());
}

// what moves is drawn as soon as can be, what stands still with smooth edges and where it came to
void Window::smoothen(const Sample& newest)
{
  constexpr int kStill = 12; // pictures
  if (++still_ == kStill)
  {
    setSmooth(true);
    shown_ = newest;
    view_.show(shown_);
    renderWindow_->Render();
    showReadings();
  }
}

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
      vtkNew<vtkRenderWindow> window;
      window->SetShowWindow(false);
      window->SetOffScreenRendering(1);
      window->SetSize(size.width, size.height);
      const auto asHere = [this](PressView&, vtkRenderer& renderer)
      {
        renderer.GetActiveCamera()->DeepCopy(renderer_->GetActiveCamera());
        renderer.ResetCameraClippingRange();
      };
      const Pictured seen = pictured();
      const Sample sample = moment.value_or(shown_);
      vtkSmartPointer<vtkImageData> picture;
      drawFigure(*window, momentOf(seen.body, seen.recording, seen.calibration, sample, shownMap()),
        look, asHere,
        [&](PressView&, Surroundings&, vtkRenderer&) {
          picture =
            pictureOf(*window, look.isTransparent ? Backdrop::Transparent : Backdrop::Opaque);
        });
      // a large one is longer in becoming a file than in being drawn
      const auto written = inBackground<bool>(tr("Writing the figure"),
        [picture, to = file.toStdString()](const std::atomic<bool>& isWanted)
        {
          isWanted ? writePng(*picture, to) : void();
          return true;
        });
      say(written ? tr("Written to %1: %2 x %3 pixels").arg(file).arg(size.width).arg(size.height)
                  : tr("Not waited for: %1 may still be written").arg(file));
    });
}

} // namespace palp
