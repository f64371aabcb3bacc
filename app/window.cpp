#include "app/window.h"

#include "app/deformed.h"
#include "app/surface_point.h"
#include "app/tissue_panel.h"
#include "app/vtkPalpPressStyle.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <QAction>
#include <QDockWidget>
#include <QFileDialog>
#include <QKeyEvent>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QStatusBar>
#include <QTimer>

#include <algorithm>
#include <fstream>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kFrameMs = 16;   // the picture
constexpr int kPlotMs = 100;   // the curves, which cost more and need less
constexpr double kDepthPerPixel = 0.05_mm;
constexpr double kDepthPerNotch = 0.5_mm;
constexpr double kDeepest = 50.0_mm;

QDockWidget* addDock(QMainWindow* window, Qt::DockWidgetArea area, const QString& title, QWidget* content)
{
  auto* dock = new QDockWidget(title, window);
  dock->setObjectName(title);
  dock->setWidget(content);
  dock->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetFloatable);
  window->addDockWidget(area, dock);
  return dock;
}

} // namespace

Window::Window(Session& session)
  : session_(session)
{
  setWindowTitle(tr("Palp — %1").arg(QString::fromStdString(session.body().name)));
  resize(1440, 860);
  makeView();
  makeDocks();
  makeMenus();

  frames_ = new QTimer(this);
  connect(frames_, &QTimer::timeout, this, &Window::refresh);
  frames_->start(kFrameMs);
  plots_ = new QTimer(this);
  connect(plots_, &QTimer::timeout, this, &Window::refreshCharts);
  plots_->start(kPlotMs);
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
  view_ = std::make_unique<PressView>(*renderer_, *session_.body().display);

  style_->Hover = [this](int x, int y) { pointer_.hover(x, y); };
  canvas_->interactor()->SetInteractorStyle(style_);
}
