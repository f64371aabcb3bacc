#include "app/window.h"

#include "app/export.h"
#include "app/reliance_panel.h"
#include "app/tissue_panel.h"
#include "app/vtkPalpPressStyle.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <QAction>
#include <QDockWidget>
#include <QFileDialog>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QStatusBar>
#include <QTimer>

#include <algorithm>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kFrameMs = 16;               // the picture
constexpr int kPlotMs = 100;               // the curves, which cost more and need less
constexpr double kHover = 3.0_mm;          // of the apex above the surface
constexpr double kDepthPerPixel = 0.05_mm; // of a drag
constexpr double kDepthPerNotch = 0.5_mm;  // of the wheel
constexpr double kDeepest = 50.0_mm;

QDockWidget* addDock(
  QMainWindow* window, Qt::DockWidgetArea area, const QString& title, QWidget* content)
{
  auto* dock = new QDockWidget(title, window);
  dock->setObjectName(title);
  dock->setWidget(content);
  dock->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetFloatable);
  window->addDockWidget(area, dock);
  return dock;
}

QVTKOpenGLNativeWidget* makeChartCanvas(vtkContextView& view)
{
  auto* canvas = new QVTKOpenGLNativeWidget;
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  window->SetMultiSamples(0);
  canvas->setRenderWindow(window);
  canvas->setMinimumSize(360, 200);
  view.SetRenderWindow(window);
  view.GetRenderer()->SetBackground(1.0, 1.0, 1.0);
  return canvas;
}

// a place of the picture, 0 at the near plane and 1 at the far one
Eigen::Vector3d worldPoint(vtkRenderer& renderer, int x, int y, double depth)
{
  renderer.SetDisplayPoint(x, y, depth);
  renderer.DisplayToWorld();
  const double* world = renderer.GetWorldPoint();
  return Eigen::Vector3d(world[0], world[1], world[2]) / world[3];
}

} // namespace

Window::Window(Session& session)
  : session_(session)
  , view_(*renderer_)
  , validity_(session.recording().scene.law)
{
  resize(1440, 860);
  makeView();
  makeDocks();
  makeMenus();
  showBody();
  applyTissue();

  auto* frames = new QTimer(this);
  connect(frames, &QTimer::timeout, this, &Window::refresh);
  frames->start(kFrameMs);
  auto* plots = new QTimer(this);
  connect(plots, &QTimer::timeout, this, &Window::refreshCharts);
  plots->start(kPlotMs);
}

Window::~Window() = default;

void Window::makeView()
{
  canvas_ = new QVTKOpenGLNativeWidget(this);
  canvas_->setObjectName("canvas");
  canvas_->setRenderWindow(renderWindow_);
  renderWindow_->SetMultiSamples(0);
  renderWindow_->AddRenderer(renderer_);
  setCentralWidget(canvas_);

  style_->Hover = [this](int x, int y) { point(x, y); };
  style_->Press = [this](int x, int y)
  {
    point(x, y);
    pressing_ = true;
    setDepth(heldDepth_);
  };
  style_->Drag = [this](int pixelsDown) { setDepth(heldDepth_ + pixelsDown * kDepthPerPixel); };
  style_->Release = [this]
  {
    pressing_ = false;
    setDepth(heldDepth_);
  };
  style_->Wheel = [this](int notches)
  {
    heldDepth_ = std::clamp(heldDepth_ + notches * kDepthPerNotch, 0.0, kDeepest);
    setDepth(heldDepth_);
  };
  canvas_->interactor()->SetInteractorStyle(style_);
}

void Window::makeDocks()
{
  const Recording& recording = session_.recording();
  QStringList devices{ "mouse", "hand" };
  const QString device = QString::fromStdString(recording.device);
  devices.removeAll(device);
  devices.prepend(device);
  panel_ = new TissuePanel(recording.scene, devices);
  connect(panel_, &TissuePanel::tissueChanged, this, &Window::applyTissue);
  connect(panel_, &TissuePanel::deviceChanged, this, &Window::applyDevice);
  connect(panel_, &TissuePanel::armAsked, this,
    [this](bool armed)
    {
      session_.stop(false);
      session_.arm(armed);
    });
  addDock(this, Qt::LeftDockWidgetArea, tr("Tool and tissue"), panel_);
  reliance_ = new ReliancePanel;
  addDock(this, Qt::LeftDockWidgetArea, tr("Reliance"), reliance_);

  addDock(this, Qt::RightDockWidgetArea, tr("Force over time"), makeChartCanvas(*timeView_));
  addDock(this, Qt::RightDockWidgetArea, tr("Force over depth"), makeChartCanvas(*depthView_));
  charts_.addForceOverTime(*timeView_->GetScene());
  charts_.addForceOverDepth(*depthView_->GetScene());

  forceLabel_ = new QLabel(tr("Point at the surface, press with the left button, drag down to go "
                              "deeper; the wheel holds a depth; right button turns the view"));
  forceLabel_->setObjectName("force");
  servoLabel_ = new QLabel;
  servoLabel_->setObjectName("servo");
  statusBar()->addWidget(forceLabel_, 1);
  statusBar()->addPermanentWidget(servoLabel_);
}

void Window::makeMenus()
{
  QMenu* file = menuBar()->addMenu(tr("&File"));
  file->addAction(
    tr("&Open surface…"), this,
    [this]
    {
      const QString name = QFileDialog::getOpenFileName(
        this, tr("Open surface"), {}, tr("Surfaces (*.stl *.obj *.ply *.off *.vtk *.vtp)"));
      if (!name.isEmpty())
      {
        openSurface(name, "auto");
      }
    },
    QKeySequence::Open);
  file->addAction(
    tr("Save &screenshot…"), this,
    [this]
    {
      const QString name =
        QFileDialog::getSaveFileName(this, tr("Save screenshot"), "palp.png", tr("PNG (*.png)"));
      if (!name.isEmpty())
      {
        saveScreenshot(name);
      }
    },
    QKeySequence::Save);
  file->addAction(tr("&Export data…"), this,
    [this]
    {
      const QString name = QFileDialog::getExistingDirectory(this, tr("Export data into"));
      if (!name.isEmpty())
      {
        exportData(name);
      }
    });
  file->addSeparator();
  file->addAction(tr("&Quit"), this, &QWidget::close, QKeySequence::Quit);

  QMenu* device = menuBar()->addMenu(tr("&Device"));
  QAction* stop = device->addAction(
    tr("&Stop the force"), this, [this] { session_.stop(true); }, QKeySequence(Qt::Key_Escape));
  stop->setShortcutContext(Qt::ApplicationShortcut); // wherever the focus is

  QMenu* view = menuBar()->addMenu(tr("&View"));
  view->addAction(
    tr("Whole &surface"), this, [this] { view_.lookAtSurface(); }, QKeySequence(Qt::Key_Home));
  const std::pair<QString, Overlay> overlays[] = { { tr("&Force arrow"), Overlay::ForceArrow },
    { tr("&Contact circle"), Overlay::ContactCircle },
    { tr("&Extent circle"), Overlay::ExtentCircle },
    { tr("&Displacement colours"), Overlay::DisplacementColors },
    { tr("&Readings"), Overlay::Readings }, { tr("&Pressure colours"), Overlay::PressureColors },
    { tr("&Validity colours"), Overlay::ValidityColors },
    { tr("Bézier control &net"), Overlay::ControlNet },
    { tr("&Undeformed surface"), Overlay::Ghost } };
  for (const auto& [name, overlay] : overlays)
  {
    QAction* action = view->addAction(name);
    action->setCheckable(true);
    action->setChecked(view_.isVisible(overlay));
    connect(action, &QAction::toggled, this,
      [this, which = overlay](bool on) { view_.setVisible(which, on); });
  }
}

void Window::showBody()
{
  setWindowTitle(tr("Palp — %1").arg(QString::fromStdString(session_.body().name)));
  view_.setSurface(session_.body().display);
  view_.lookAtSurface();
}

void Window::point(int x, int y)
{
  const Eigen::Vector3d near = worldPoint(*renderer_, x, y, 0.0);
  const Eigen::Vector3d far = worldPoint(*renderer_, x, y, 1.0);
  target_ = pick(*session_.body().haptic, near, (far - near).normalized());
  aim();
}

void Window::setDepth(double depth)
{
  depth_ = std::clamp(depth, 0.0, kDeepest);
  aim();
}

void Window::aim()
{
  if (target_)
  {
    const bool lifted = !pressing_ && depth_ == 0.0;
    const double below = lifted ? -kHover : depth_;
    session_.aim({ .apex = target_->position - below * target_->normal,
      .axis = -target_->normal,
      .lifted = lifted && !session_.newest().contact.touching() });
  }
}

void Window::refresh()
{
  session_.update([this](const Sample& sample) { charts_.add(sample); });
  const Sample& sample = session_.newest();
  view_.show(sample);
  renderWindow_->Render();

  if (sample.contact.touching())
  {
    forceLabel_->setText(
      tr("Force %1 N    depth %2 mm    stiffness %3 N/mm")
        .arg(sample.response.force, 0, 'f', 2)
        .arg(units::toMillimetres(sample.contact.depth), 0, 'f', 1)
        .arg(units::toNewtonsPerMillimetre(sample.response.stiffness), 0, 'f', 2));
  }
}

void Window::refreshCharts()
{
  panel_->showDevice(session_.newest(), session_.rendersForce(), session_.armed());
  showReliance(session_.newest());
  charts_.refresh();
  timeView_->GetRenderWindow()->Render();
  depthView_->GetRenderWindow()->Render();

  const Timing& timing = session_.timing();
  const auto ticks = timing.ticks.load();
  const auto late = timing.skipped.load();
  const double elapsed = static_cast<double>(ticks + late);
  servoLabel_->setText(
    tr("servo %1 Hz    late ticks %2")
      .arg(elapsed > 0.0 ? 1000.0 * static_cast<double>(ticks) / elapsed : 0.0, 0, 'f', 0)
      .arg(late));
}

void Window::showReliance(const Sample& sample)
{
  const Contact& contact = sample.contact;
  if (contact.touching())
  {
    reliance_->showRules(validity_({ .depth = contact.depth,
                                     .tilt = contact.tilt,
                                     .thickness = contact.thickness,
                                     .surfaceCurvature = contact.surfaceCurvature,
                                     .curvatureSpread = contact.curvatureSpread },
      contact.edgeDistance));
  }
  else
  {
    reliance_->showNoContact();
  }
  reliance_->showTiming(session_.timing(), session_.schedule());
}

void Window::applyTissue()
{
  attempt(
    [this]
    {
      const ForceLaw law = panel_->law();
      session_.setTissue(law, panel_->rule(), panel_->damping());
      validity_ = Validity(law, { .stableStiffness = session_.stableStiffness() });
      view_.setTip(law.tip());
      view_.setLaw(law);
      view_.setExtents(session_.calibration().extents);
      view_.setFitted(session_.calibration().surfaces);
      charts_.setLaw(law);
    });
}

void Window::applyDevice(const QString& name)
{
  attempt([&] { session_.useDevice(name.toStdString()); });
  charts_.clear();
  applyTissue(); // what is stable depends on the device
}

bool Window::openSurface(const QString& file, const QString& unit)
{
  return attempt(
    [&]
    {
      session_.open(file.toStdString(), unit.toStdString());
      target_.reset();
      charts_.clear();
      showBody();
    });
}

bool Window::saveScreenshot(const QString& file)
{
  return attempt(
    [&]
    {
      renderWindow_->Render();
      if (!canvas_->grabFramebuffer().save(file))
      {
        throw Error(ErrorCode::BadFile,
          file.toStdString() + ": cannot be written; choose another folder or a name in .png");
      }
    });
}

bool Window::exportData(const QString& directory)
{
  return attempt(
    [&]
    {
      session_.update([this](const Sample& sample) { charts_.add(sample); });
      writeTiming(std::filesystem::path(directory.toStdString()) / "servo.csv", session_.timing());
      exportRecording(
        directory.toStdString(), session_.body(), session_.recording(), session_.calibration());
      statusBar()->showMessage(tr("Written to %1").arg(directory), 5000);
    });
}

bool Window::attempt(const std::function<void()>& work)
{
  try
  {
    work();
    return true;
  }
  catch (const std::exception& error)
  {
    QMessageBox::warning(this, tr("Palp"), QString::fromStdString(error.what()));
    return false;
  }
}

} // namespace palp
